#pragma once

#include "store/run/run_reader.hpp"

#include <string>
#include <utility>
#include <vector>

namespace gnomon::store {

/// The command that computes the run, or its part of a divided sweep, without the output folder.
[[nodiscard]] std::string run_command(const RunDescription& description);

/// The command that computes one configuration with all its layers; empty if unknown.
[[nodiscard]] std::string compare_command(const RunDescription& description, const ResultRow& row);
/// @param case_name  empty without cases.
/// @param axes       keys of the sweep and their values.
[[nodiscard]] std::string
compare_command(const RunDescription& description, const std::string& case_name,
                const std::vector<std::pair<std::string, std::string>>& axes);

/// "--light=sun": one word, because a light's name may begin with a hyphen.
[[nodiscard]] std::string light_option(const std::string& light);

/// The keys and values of a configuration's job, in the order of `job_columns`, then engine keys.
/// Keys without a value are left out.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> job_settings(const ResultRow& row);

} // namespace gnomon::store
