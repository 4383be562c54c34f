#pragma once

#include "analysis/lookup/lookup_rule.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace gnomon::analysis {

/// The critical bias of one comparison: the smallest constant bias with which it is lit.
///
///     the smallest b with   fl(r − fl(b + s)) <= d      reversed:   fl(r + fl(b + s)) >= d
///
/// over all biases b: 0 and the normal float32 of either sign. Both subtractions are monotone, so
/// every larger bias is lit too. Subnormal intermediate results are kept, as IEEE 754 says; a
/// driver that flushes them can differ only where |r| < 2^-102.
/// @param r           Receiver depth.
/// @param d           Map depth; NaN is lit with no bias.
/// @param slope_term  s = fl(slope · tan θ).
/// @return  A bias; −∞ if every bias is lit, +∞ if none is.
/// Source: docs/bias_curve.md#critical-bias.
[[nodiscard]] float critical_bias(float r, float d, float slope_term, bool reversed);

/// The smallest bias that times the scale is at least `scaled`: with which a map compares alike.
///
///     the smallest b with   fl(b · scale) >= scaled
///
/// @param scaled  A bias, or ±∞, which stays what it is.
/// @param scale   Positive, finite.
[[nodiscard]] float unscaled_bias(float scaled, float scale);

/// A lookup's comparison, both depth directions in one form: negating both sides of
/// fl(r − y) <= d gives fl(y − r) >= −d, for rounding is symmetric.
struct OneWayComparison {
    float addend;
    float threshold; ///< a threshold of 0 is −0: the float below it is the next one of its sign
    float slope_term;

    /// The arguments are those of `critical_bias`.
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

/// Comparisons laid out for vector instructions: their critical biases, a block at a time.
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
    /// The critical biases of the first `count` comparisons, as `critical_bias` gives them.
    [[nodiscard]] std::span<const float> solve(std::size_t count);

private:
    using Values = std::array<float, size>;

    Values addends_{};
    Values thresholds_{};
    Values slope_terms_{};
    Values criticals_{};
};

/// Makes each verdict the one with this constant bias: 1 or 0, that of the majority of its taps.
/// @param criticals  The lookup's `critical_biases`.
void set_verdicts(scene::LookupLayers& lookup, const scene::Image<float>& criticals, float bias);

/// Critical biases that say nothing but the lookup's own verdicts: −∞ where it is lit, else +∞.
[[nodiscard]] scene::Image<float> criticals_of_verdicts(const scene::LookupLayers& lookup);

/// The critical bias of each pixel.
/// @param lookup  Of a nearest or linear lookup, or from `deciding_samples`. Where `map_depth` is
///                NaN the border mode decides. Pixels without a receiver, all zero, get 0.
[[nodiscard]] scene::Image<float> critical_biases(const scene::LookupLayers& lookup,
                                                  const LookupRule& rule);

} // namespace gnomon::analysis
