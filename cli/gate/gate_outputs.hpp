#pragma once

#include "reports/gate/gate_report.hpp"

#include <filesystem>

namespace gnomon::cli {

/// Draws pictures of pixels that became wrong, in that folder or, if it is empty, in RUN/gate;
/// there pictures that cannot be drawn are a message only, for nobody asked for them.
void draw_gate_pictures(reports::GateReport& report, const std::filesystem::path& folder);

/// Prints workflow commands for GitHub Actions, and appends a summary to the file that
/// GITHUB_STEP_SUMMARY names, which stays below 1 MiB.
/// @throws scene::EnvironmentError  if it cannot be written.
void print_for_github(const reports::GateReport& report);

} // namespace gnomon::cli
