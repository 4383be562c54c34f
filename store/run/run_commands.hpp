#pragma once

#include "store/run/run_reader.hpp"

#include <string>
#include <utility>
#include <vector>

namespace gnomon::store {

/// The command that computes the run, but for its folder; of a part of a divided sweep that part.
[[nodiscard]] std::string run_command(const RunDescription& description);

/// The command that computes one configuration with all its layers; empty if it is not known.
[[nodiscard]] std::string compare_command(const RunDescription& description, const ResultRow& row);
/// @param case_name  Empty without cases.
/// @param axes       The sweep's keys and their values.
[[nodiscard]] std::string
compare_command(const RunDescription& description, const std::string& case_name,
                const std::vector<std::pair<std::string, std::string>>& axes);

/// "--light=sun": in one word, as a light's name may begin with hyphens.
[[nodiscard]] std::string light_option(const std::string& light);

/// A configuration's job: its keys with their values as text, in the order of `job_columns`; keys
/// without a value are left out. Another renderer's own keys come last.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> job_settings(const ResultRow& row);

} // namespace gnomon::store
