#pragma once

#include "analysis/causes/pixel_causes.hpp"
#include "analysis/lookup/taps.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The smallest biases that leave at most the allowed acne; −∞ if every bias does, +∞ if none does.
struct AcneFree {
    float by_tap = 0; ///< counts shadowed taps of lit pixels that see their self-shadowing surface
    float by_count = 0; ///< counts pixels of the label `acne`, on the wrong side of one half
};

/// Finds them for several allowed amounts of acne [px].
using FindAcneFree =
    std::function<std::vector<AcneFree>(std::span<const std::uint64_t> allowed_pixels)>;

/// Inputs for finding acne; all images have one size.
struct AcneInputs {
    const scene::Image<scene::PixelClass>& classes;
    const scene::Image<float>& critical_bias; ///< of each pixel's verdict
    const PixelCauses& causes;
    const TapCriticals* taps = nullptr; ///< null if one texel is read
    bool adds_taps = false;   ///< verdicts are shares of taps; otherwise both results count pixels
    bool weighs_taps = false; ///< false: all of a pixel's taps have equal weight
};

/// Finds the acne-free biases. A tap stops shadowing at its critical bias. A pixel is acne while it
/// is wrong and its self-shadowing surface accounts for at least half of its shadow.
/// @return  In the order of `allowed_pixels`.
/// Source: docs/bias_curve.md#limits.
[[nodiscard]] std::vector<AcneFree> find_acne_free(const AcneInputs& inputs,
                                                   std::span<const std::uint64_t> allowed_pixels);

} // namespace gnomon::analysis
