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
    std::string range;  ///< "near 0.5 m, far 10 m, cull none"
    std::string lookup; ///< "nearest, outside lit"
    std::string bias;   ///< "constant 0.0005, slope 0, normal 0 texels"
    std::string image;  ///< "1280x720"
};

[[nodiscard]] Description describe(const analysis::Comparison& comparison);

/// The renderer's name without what follows in parentheses: "llvmpipe".
[[nodiscard]] std::string renderer_in_brief(const analysis::Comparison& comparison);

/// The settings of GL's own map in one line: "map 1024x1024 d24, fit scene; pcf3; bias slope 1;
/// image 1280x720; llvmpipe". Biases of 0 are left out.
[[nodiscard]] std::string settings_in_brief(const analysis::Comparison& comparison);

/// "bias constant 0.006, slope 1": the terms of GL's own bias that are not 0, or "no bias".
[[nodiscard]] std::string bias_in_brief(const analysis::Comparison& comparison);

/// " in cascade 2": the cascade whose texels give a bias's length; empty for other layouts.
[[nodiscard]] std::string map_of_lengths(const analysis::Comparison& comparison);

/// "17 reruns of GL: 0 of 39,168 verdicts differ"
[[nodiscard]] std::string verification_text(const analysis::BiasVerification& found);

/// The unit of the comparison's lengths: "m", or "units" if a scene file does not give its unit.
/// Always "m" for another renderer's case.
[[nodiscard]] std::string_view length_unit(const analysis::Comparison& comparison);

} // namespace gnomon::reports
