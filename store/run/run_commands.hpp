#pragma once

#include "store/run/run_reader.hpp"

#include <string>
#include <utility>
#include <vector>

namespace gnomon::store {

/// The command that computes the run, but for its folder; of a part of a divided sweep that part.
[[nodiscard]] std::string run_command(const RunDescription& description);

/// The command that computes one configuration with all its layers.
[[nodiscard]] std::string compare_command(const RunDescription& description, const ResultRow& row);
/// @param case_name  Empty without cases.
/// @param axes       The sweep's keys and their values.
[[nodiscard]] std::string
compare_command(const RunDescription& description, const std::string& case_name,
                const std::vector<std::pair<std::string, std::string>>& axes);

/// The settings of a configuration that are not its own alone: scene, camera, light, map, lookup,
/// bias, as the job's keys and values.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> job_settings(const ResultRow& row);

} // namespace gnomon::store
