#pragma once

#include "analysis/depth/depth_mapping.hpp"
#include "scene/light/depth_range.hpp"

#include <string>
#include <string_view>

namespace gnomon::reports {

/// "minus_one_to_one", "zero_to_one": as in options and JSON.
[[nodiscard]] std::string_view clip_range_name(scene::ClipRange range);
/// "perspective, near 4 m, far 50 m, clip [-1, 1]", with "reversed" where it is.
[[nodiscard]] std::string range_text(const scene::DepthRange& range);
/// The same of what a mapping maps: "distance over far, near 4 m, far 50 m".
[[nodiscard]] std::string mapping_text(const analysis::DepthMapping& mapping);
/// "z" is the distance from the camera's plane, "r" that from the light.
[[nodiscard]] std::string_view distance_symbol(const analysis::DepthMapping& mapping);
/// A length with four digits: "0.004387 m".
[[nodiscard]] std::string metres(double length_m);

} // namespace gnomon::reports
