#pragma once

#include "analysis/causes/pixel_causes.hpp"
#include "analysis/lookup/tap_criticals.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The smallest biases that leave no more than so much acne; −∞ where every bias does, +∞ where
/// none does.
struct AcneFree {
    float by_tap =
        0; ///< counted in shadowed taps of lit pixels that see their self-shadowing surface
    float by_count = 0; ///< counted in pixels of the label `acne`, on the wrong side of one half
};

/// Finds them for several amounts of acne that are allowed [px].
using FindAcneFree =
    std::function<std::vector<AcneFree>(std::span<const std::uint64_t> allowed_pixels)>;

/// What acne is found from; images of one size.
struct AcneInputs {
    const scene::Image<scene::PixelClass>& classes;
    const scene::Image<float>& critical_bias; ///< of each pixel's verdict
    const PixelCauses& causes;
    const TapCriticals* taps = nullptr; ///< nullptr where one texel is read
    bool adds_taps = false;             ///< verdicts are shares of taps; else both are by count
    bool weighs_taps = false;           ///< else all of a pixel's taps weigh the same
};

/// Above the critical bias of a tap it shadows no more; a pixel is acne as long as it is wrong and
/// at least half of what shadows it is its self-shadowing surface.
/// @return  In the order of `allowed_pixels`.
/// Source: docs/bias_curve.md#limits.
[[nodiscard]] std::vector<AcneFree> find_acne_free(const AcneInputs& inputs,
                                                   std::span<const std::uint64_t> allowed_pixels);

} // namespace gnomon::analysis
