#pragma once

#include "scene/case/case_layers.hpp"

#include <string>

namespace gnomon::cli {

/// Where two frames differ, bit by bit: "the mask differs at 12 pixels, first at (3, 4)"; empty if
/// they do not.
[[nodiscard]] std::string frame_difference(const scene::CaseLayers& a, const scene::CaseLayers& b);

} // namespace gnomon::cli
