#pragma once

#include "analysis/depth/depth_study.hpp"
#include "reports/depth/drawing.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// Error against distance: the formula's sawtooth and envelope, and what GL stored, on a log axis;
/// the distance's axis is a log one too where far is more than 100 times near. The study's
/// tolerance is a level, and a line down from where the envelope exceeds it first.
/// @param rows  measured ones, by growing distance; what the study has not measured is not drawn.
[[nodiscard]] Drawing depth_plot(const analysis::DepthStudy& study,
                                 std::span<const analysis::DepthErrorRow> rows,
                                 const std::string& gl_renderer);

} // namespace gnomon::reports
