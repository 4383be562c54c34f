#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>
#include <string_view>

namespace gnomon::reports {

/// A comparison's settings in a few words, for tables and pictures, with units.
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

/// The unit of the comparison's lengths: "m", or "units" if a scene file does not give its unit.
/// Always "m" for another renderer's case.
[[nodiscard]] std::string_view length_unit(const analysis::Comparison& comparison);

} // namespace gnomon::reports
