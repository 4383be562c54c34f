#include "analysis/lookup/critical_bias.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "scene/infinity.hpp"
#include "scene/widest_vectors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace gnomon::analysis {

namespace {

using scene::infinity;

constexpr float not_a_depth = std::numeric_limits<float>::quiet_NaN();

// The following functions have no branches, so that the loop over pixels is vectorised. They guess
// in doubles, and then check the guess in float32.

constexpr std::uint32_t smallest_normal_bits = 0x00800000;
constexpr std::uint32_t sign_bit = 0x80000000;

/// The float below x; below either zero, the negative subnormal.
float float_below(float x)
{
    // Turns either zero into −0: a sum is +0 where subnormals are flushed, as in TBB's threads once
    // Embree has started them.
    const auto bits = std::bit_cast<std::uint32_t>(-(0.0F - x));
    return std::bit_cast<float>(bits + 2 * (bits >> 31) - 1);
}

/// The float above x; NaN for −0.
float float_above(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(bits + 1 - 2 * (bits >> 31));
}

/// The smallest float32 y with fl(y + addend) >= target, unless the doubles below round.
float guess_summand(float addend, float target)
{
    // A sum above the midpoint below the target rounds to the target or beyond; the midpoint rounds
    // to the even neighbour.
    const double midpoint = 0.5 * (double{target} + double{float_below(target)});
    const auto y = static_cast<float>(midpoint - double{addend});
    return y + addend >= target ? y : float_above(y);
}

/// The critical bias; in rare cases NaN.
float guess_critical_bias(const OneWayComparison& comparison)
{
    const float sum = guess_summand(comparison.addend, comparison.threshold);
    const float summand = guess_summand(comparison.slope_term, sum);
    const auto bits = std::bit_cast<std::uint32_t>(summand);
    // A subnormal becomes the next valid bias above it; the one below 0 is the negative smallest
    // normal.
    const std::uint32_t magnitude = bits & ~sign_bit;
    const std::uint32_t beside_zero = bits - 1 < smallest_normal_bits ? smallest_normal_bits : 0;
    const std::uint32_t guess_bits = magnitude < smallest_normal_bits ? beside_zero : bits;
    const std::uint32_t below_bits = guess_bits + 2 * (guess_bits >> 31) - 1;
    const auto guess = std::bit_cast<float>(guess_bits);
    const auto below =
        std::bit_cast<float>(guess_bits == 0 ? smallest_normal_bits | sign_bit : below_bits);
    // Below the smallest normal this tries a subnormal, so a right guess may be rejected.
    const float if_lit = comparison.is_lit(guess) ? guess : not_a_depth;
    const float if_known = comparison.is_lit(below) ? not_a_depth : if_lit;
    // Beyond 2^126 a guess may be the largest float, which proves nothing.
    return std::abs(guess) < 0x1p126F ? if_known : not_a_depth;
}

float search_critical_bias(const OneWayComparison& comparison)
{
    if (comparison.is_lit(bias_of_rank(-largest_bias_rank))) {
        return -infinity;
    }
    std::int32_t shadowed = -largest_bias_rank;
    std::int32_t lit = largest_bias_rank + 1; // infinity: it stands for "none"
    while (lit - 1 > shadowed) {
        const std::int32_t middle = std::midpoint(shadowed, lit);
        (comparison.is_lit(bias_of_rank(middle)) ? lit : shadowed) = middle;
    }
    return bias_of_rank(lit);
}

GNOMON_WIDEST_VECTORS
void guess_all(const float* addends, const float* thresholds, const float* slope_terms,
               float* guesses, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        guesses[i] = guess_critical_bias({addends[i], thresholds[i], slope_terms[i]});
    }
}

} // namespace

std::span<const float> ComparisonBlock::solve(std::size_t count)
{
    guess_all(addends_.data(), thresholds_.data(), slope_terms_.data(), criticals_.data(), count);
    for (std::size_t i = 0; i < count; ++i) {
        if (std::isnan(criticals_[i])) [[unlikely]] {
            criticals_[i] =
                std::isnan(thresholds_[i])
                    ? infinity
                    : search_critical_bias({addends_[i], thresholds_[i], slope_terms_[i]});
        }
    }
    return std::span{criticals_}.first(count);
}

float critical_bias(float r, float d, float slope_term, bool reversed)
{
    const OneWayComparison comparison = OneWayComparison::of(r, d, slope_term, reversed);
    const float guess = guess_critical_bias(comparison);
    return std::isnan(guess) ? search_critical_bias(comparison) : guess;
}

float unscaled_bias(float scaled, float scale)
{
    if (scaled == 0 || std::isinf(scaled)) {
        return scaled;
    }
    const auto reaches = [&](std::int32_t rank) { return bias_of_rank(rank) * scale >= scaled; };
    const double guess = double{scaled} / double{scale};
    constexpr double largest{std::numeric_limits<float>::max()};
    const auto rounded = static_cast<float>(std::clamp(guess, -largest, largest));
    std::int32_t rank = std::fpclassify(rounded) == FP_NORMAL ? bias_rank(rounded) : 0;
    while (rank <= largest_bias_rank && !reaches(rank)) {
        ++rank;
    }
    while (rank > -largest_bias_rank && reaches(rank - 1)) {
        --rank;
    }
    return bias_of_rank(rank);
}

void set_verdicts(scene::LookupLayers& lookup, const scene::Image<float>& criticals, float bias)
{
    for_each_run(criticals.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            lookup.samples[i].verdict = criticals[i] <= bias ? 1.0F : 0.0F;
        }
    });
}

scene::Image<float> criticals_of_verdicts(const scene::LookupLayers& lookup)
{
    scene::Image<float> criticals{lookup.samples.size()};
    for_each_run(criticals.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            criticals[i] = scene::is_lit(lookup.samples[i].verdict) ? -infinity : infinity;
        }
    });
    return criticals;
}

scene::Image<float> critical_biases(const scene::LookupLayers& lookup, const LookupRule& rule)
{
    scene::Image<float> result{lookup.samples.size()};
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        ComparisonBlock block;
        for (std::size_t start = first; start < last; start += ComparisonBlock::size) {
            const std::size_t count = std::min(ComparisonBlock::size, last - start);
            const scene::LookupSample* const samples = lookup.samples.data() + start;
            for (std::size_t i = 0; i < count; ++i) {
                block.set(i,
                          OneWayComparison::of(samples[i].receiver_depth, samples[i].map_depth,
                                               rule.slope * samples[i].tan_theta, rule.reversed));
            }
            const auto criticals = block.solve(count);
            for (std::size_t i = 0; i < count; ++i) {
                const float scale = rule.bias_scale(scene::map_of(lookup.maps, start + i));
                result[start + i] =
                    std::isnan(samples[i].map_depth)
                        ? rule.border_critical_bias()
                        : (scale == 1 ? criticals[i] : unscaled_bias(criticals[i], scale));
            }
        }
    });
    return result;
}

} // namespace gnomon::analysis
