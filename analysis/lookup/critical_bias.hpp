#pragma once

#include "analysis/lookup/lookup_rule.hpp"
#include "scene/image.hpp"
#include "scene/infinity.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// The critical bias of one comparison: the smallest constant bias that makes it lit.
///
///     the smallest b with   fl(r − fl(b + s)) <= d      reversed:   fl(r + fl(b + s)) >= d
///
/// over all biases b: 0 and the normal float32 of either sign. Both subtractions are monotone, so
/// every larger bias is lit too. Subnormal intermediate results are kept, as IEEE 754 requires. A
/// driver that flushes them can differ only where |r| < 2^-102.
/// @param r           Receiver depth.
/// @param d           Map depth; no bias lights NaN.
/// @param slope_term  s = fl(slope · tan θ).
/// @return  A bias; −∞ if every bias is lit, +∞ if none is.
/// Source: docs/bias_curve.md#critical-bias.
[[nodiscard]] float critical_bias(float r, float d, float slope_term, bool reversed);

/// The smallest bias that, multiplied by the scale, is at least `scaled`.
///
///     the smallest b with   fl(b · scale) >= scaled
///
/// @param scaled  A bias, or ±∞, which is returned unchanged.
/// @param scale   Positive, finite.
[[nodiscard]] float unscaled_bias(float scaled, float scale);

/// A lookup's comparison in one form for both depth directions. Negating both sides of fl(r − y) <=
/// d gives fl(y − r) >= −d, since rounding is symmetric.
struct OneWayComparison {
    float addend;
    float threshold; ///< 0 is stored as −0, so that the float below it is its neighbour
    float slope_term;

    /// Takes the arguments of `critical_bias`.
    static OneWayComparison of(float r, float d, float slope_term, bool reversed)
    {
        return reversed ? OneWayComparison{r, -(0.0F - d), slope_term}
                        : OneWayComparison{-r, -d, slope_term};
    }
    [[nodiscard]] bool is_lit(float bias) const
    {
        const float whole = bias + slope_term;
        return whole + addend >= threshold;
    }
};

/// A block of comparisons, laid out for vector instructions.
class ComparisonBlock {
public:
    static constexpr std::size_t size = 256;

    /// Sets the i-th comparison, i < `size`.
    void set(std::size_t i, const OneWayComparison& comparison)
    {
        addends_[i] = comparison.addend;
        thresholds_[i] = comparison.threshold;
        slope_terms_[i] = comparison.slope_term;
    }
    /// Returns the critical biases of the first `count` comparisons (see `critical_bias`).
    [[nodiscard]] std::span<const float> solve(std::size_t count);

private:
    using Values = std::array<float, size>;

    Values addends_{};
    Values thresholds_{};
    Values slope_terms_{};
    Values criticals_{};
};

/// Sets each verdict to the one at this constant bias: 1 or 0, the majority of its taps.
/// @param criticals  The lookup's `critical_biases`.
void set_verdicts(scene::LookupLayers& lookup, const scene::Image<float>& criticals, float bias);

/// Critical biases that reproduce the lookup's own verdicts: −∞ where it is lit, else +∞.
[[nodiscard]] scene::Image<float> criticals_of_verdicts(const scene::LookupLayers& lookup);

/// The critical bias of each pixel; 0 for pixels without a receiver.
/// @param lookup  A nearest or linear lookup, or one from `deciding_samples`. Where `map_depth` is
///                NaN, the border mode decides.
[[nodiscard]] scene::Image<float> critical_biases(const scene::LookupLayers& lookup,
                                                  const LookupRule& rule);

/// A comparison's critical bias and its weight.
using WeighedCritical = std::pair<float, double>;

/// The smallest bias that lights comparisons of enough weight; +∞ if even all of them do not
/// suffice.
/// @param taps       In any order; reordered.
/// @param is_enough  `is_enough(lit, all)`: whether the lit weight suffices; monotone in `lit`.
template <typename IsEnough>
[[nodiscard]] float smallest_lit_bias(std::vector<WeighedCritical>& taps, const IsEnough& is_enough)
{
    double all = 0;
    for (const auto& [critical, weight] : taps) {
        all += weight;
    }
    std::ranges::sort(taps);
    double lit = 0;
    for (const auto& [critical, weight] : taps) {
        lit += weight;
        if (is_enough(lit, all)) {
            return critical;
        }
    }
    return scene::infinity;
}

} // namespace gnomon::analysis
