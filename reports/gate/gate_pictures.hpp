#pragma once

#include "reports/gate/gate_report.hpp"

#include <filesystem>

namespace gnomon::reports {

/// Draws where pixels became wrong, for the worst broken rules that fail and count pixels, where
/// baseline and run have a configuration's pixels; at most 10 pictures. Rules of the same pixels
/// share one. Notes them in the report.
/// @param folder  Made if there is something to draw.
/// @throws scene::InputError        if masks or kept pixels cannot be read.
/// @throws scene::EnvironmentError  if a picture cannot be drawn or written.
void write_gate_pictures(GateReport& report, const std::filesystem::path& folder);

} // namespace gnomon::reports
