#pragma once

#include "analysis/depth/depth_study.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// Formats side by side for one frustum, a line each.
/// @param studies  at least one.
[[nodiscard]] std::string depth_comparison_table(std::span<const analysis::DepthStudy> studies,
                                                 const std::string& gl_renderer);

/// The same as one JSON object: "formats", each theory and measurement without samples.
[[nodiscard]] std::string depth_comparison_json(std::span<const analysis::DepthStudy> studies,
                                                const std::string& gl_renderer,
                                                const std::string& gl_version);

} // namespace gnomon::reports
