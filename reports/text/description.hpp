#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>
#include <string_view>

namespace gnomon::reports {

/// What a comparison's settings say in a few words, for tables and pictures; units are spelt out.
struct Description {
    std::string size;   ///< of the scene: "98,304 triangles, 12 objects"
    std::string light;  ///< "spot, cone 60 deg"
    std::string map;    ///< "1024x1024 d24, fit scene"
    std::string range;  ///< "near 0.5, far 10, cull none"
    std::string lookup; ///< "nearest, outside lit"
    std::string bias;   ///< "constant 0.0005, slope 0, normal 0 texels"
    std::string image;  ///< "1280x720"
};

[[nodiscard]] Description describe(const analysis::Comparison& comparison);

/// What the comparison's lengths are in: "m", or "units" of a scene file whose unit nobody says. Of
/// another renderer's case they are in metres.
[[nodiscard]] std::string_view length_unit(const analysis::Comparison& comparison);

} // namespace gnomon::reports
