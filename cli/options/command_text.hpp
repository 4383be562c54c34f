#pragma once

#include "cli/options/job_options.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// What a run remembers of its job: the file's text, or what stands for it.
[[nodiscard]] std::string job_text(const JobOptions& options);

/// The command that computes a run, without where it goes, quoted for a shell.
/// @param axes  of `--axis`.
[[nodiscard]] std::string command_text(std::string_view command, const JobOptions& options,
                                       const std::vector<std::string>& axes = {});

} // namespace gnomon::cli
