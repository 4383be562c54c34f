#include "analysis/critical_bias.hpp"

#include "analysis/bias_order.hpp"
#include "analysis/pcf_taps.hpp"
#include "analysis/pixel_runs.hpp"
#include "scene/infinity.hpp"
#include "scene/widest_vectors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

using scene::infinity;
using scene::Outside;
using scene::Vec2f;

constexpr float not_a_depth = std::numeric_limits<float>::quiet_NaN();

/// The lookup's comparison, both depth directions in one form: negating both sides of
/// fl(r − y) <= d gives fl(y − r) >= −d, for rounding is symmetric.
struct Comparison {
    float addend;
    float threshold; ///< a threshold of 0 is −0, below which `float_below` works
    float slope_term;

    [[nodiscard]] bool is_lit(float bias) const
    {
        const float whole = bias + slope_term;
        return whole + addend >= threshold;
    }
};

Comparison make_comparison(float r, float d, float slope_term, bool reversed)
{
    return reversed ? Comparison{r, -(0.0F - d), slope_term} : Comparison{-r, -d, slope_term};
}

// What follows has no branches, so that the loop over pixels becomes vector instructions. It
// guesses in doubles; whether the guess is right is then tried in float32.

constexpr std::uint32_t smallest_normal_bits = 0x00800000;
constexpr std::uint32_t sign_bit = 0x80000000;

/// The float below x; NaN for +0.
float float_below(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(bits + 2 * (bits >> 31) - 1);
}

/// The float above x; NaN for −0.
float float_above(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(bits + 1 - 2 * (bits >> 31));
}

/// The smallest float32 y with fl(y + addend) >= target, unless the doubles here round.
float guess_summand(float addend, float target)
{
    // What lies above the midpoint below the target rounds to it or beyond; the midpoint itself
    // rounds to whichever neighbour is even.
    const double midpoint = 0.5 * (double{target} + double{float_below(target)});
    const auto y = static_cast<float>(midpoint - double{addend});
    return y + addend >= target ? y : float_above(y);
}

/// The critical bias, in nearly every case; else NaN.
float guess_critical_bias(const Comparison& comparison)
{
    const float sum = guess_summand(comparison.addend, comparison.threshold);
    const float summand = guess_summand(comparison.slope_term, sum);
    const auto bits = std::bit_cast<std::uint32_t>(summand);
    // A subnormal becomes the next bias above it; the one below 0 is the negative smallest normal.
    const std::uint32_t magnitude = bits & ~sign_bit;
    const std::uint32_t beside_zero = bits - 1 < smallest_normal_bits ? smallest_normal_bits : 0;
    const std::uint32_t guess_bits = magnitude < smallest_normal_bits ? beside_zero : bits;
    const std::uint32_t below_bits = guess_bits + 2 * (guess_bits >> 31) - 1;
    const auto guess = std::bit_cast<float>(guess_bits);
    const auto below =
        std::bit_cast<float>(guess_bits == 0 ? smallest_normal_bits | sign_bit : below_bits);
    // Below the smallest normal this tries a subnormal, and then a right guess may be doubted.
    const float if_lit = comparison.is_lit(guess) ? guess : not_a_depth;
    const float if_known = comparison.is_lit(below) ? not_a_depth : if_lit;
    // Beyond 2^126 a guess may stand at the end of the floats, and prove nothing.
    return std::abs(guess) < 0x1p126F ? if_known : not_a_depth;
}

float search_critical_bias(const Comparison& comparison)
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

constexpr std::size_t block_size = 256;
using BlockOf = std::array<float, block_size>;

GNOMON_WIDEST_VECTORS
void guess_all(const BlockOf& addends, const BlockOf& thresholds, const BlockOf& slope_terms,
               BlockOf& guesses)
{
    for (std::size_t i = 0; i < block_size; ++i) {
        guesses[i] = guess_critical_bias({addends[i], thresholds[i], slope_terms[i]});
    }
}

/// Comparisons laid out for vector instructions.
class ComparisonBlock {
public:
    static constexpr std::size_t size = block_size;

    void fill(const scene::LookupSample* samples, std::size_t count, const LookupRule& rule)
    {
        for (std::size_t i = 0; i < count; ++i) {
            set(i, make_comparison(samples[i].receiver_depth, samples[i].map_depth,
                                   rule.slope * samples[i].tan_theta, rule.reversed));
        }
    }
    void guess() { guess_all(addends_, thresholds_, slope_terms_, guesses_); }
    [[nodiscard]] float critical(std::size_t i, float map_depth, float policy) const
    {
        if (!std::isnan(guesses_[i])) [[likely]] {
            return guesses_[i];
        }
        return std::isnan(map_depth) ? policy : search_critical_bias(get(i));
    }

private:
    void set(std::size_t i, const Comparison& comparison)
    {
        addends_[i] = comparison.addend;
        thresholds_[i] = comparison.threshold;
        slope_terms_[i] = comparison.slope_term;
    }
    [[nodiscard]] Comparison get(std::size_t i) const
    {
        return {addends_[i], thresholds_[i], slope_terms_[i]};
    }

    BlockOf addends_{};
    BlockOf thresholds_{};
    BlockOf slope_terms_{};
    BlockOf guesses_{};
};

/// The median of the taps' depths; NaN where the policy decides.
float deciding_depth(const PcfTaps& taps, const scene::LookupSample& sample, Vec2f texel)
{
    std::array<float, scene::most_taps> depths; // filled as far as it is read
    const std::span<float> read = taps.gather(sample, texel, depths);
    if (read.empty()) {
        return not_a_depth;
    }
    float* const middle = read.data() + read.size() / 2;
    std::nth_element(read.data(), middle, read.data() + read.size());
    return std::isinf(*middle) ? not_a_depth : *middle;
}

void require_taps(const scene::LookupLayers& lookup, const scene::Image<Vec2f>& texels,
                  const scene::Image<float>& map_depths)
{
    const scene::ImageSize map = map_depths.size();
    if (texels.size() != lookup.samples.size()) {
        throw std::invalid_argument(
            fmt::format("deciding_samples: texels: {}x{}, but the lookup is {}x{}",
                        texels.size().width_px, texels.size().height_px,
                        lookup.samples.size().width_px, lookup.samples.size().height_px));
    }
    if (map.width_px != map.height_px || map_depths.empty()) {
        throw std::invalid_argument(
            fmt::format("deciding_samples: map_depths: {}x{}, but a shadow map is square",
                        map.width_px, map.height_px));
    }
}

} // namespace

float critical_bias(float r, float d, float slope_term, bool reversed)
{
    const Comparison comparison = make_comparison(r, d, slope_term, reversed);
    const float guess = guess_critical_bias(comparison);
    return std::isnan(guess) ? search_critical_bias(comparison) : guess;
}

LookupRule lookup_rule(const scene::Job& job, const scene::View& view)
{
    return {job.lookup.filter, job.lookup.outside, view.frustum.reversed, view.bias.slope};
}

scene::LookupLayers deciding_samples(scene::LookupLayers lookup, const scene::Image<Vec2f>& texels,
                                     const scene::Image<float>& map_depths, const LookupRule& rule)
{
    const scene::FilterPromises& promised = scene::promises(rule.filter);
    if (!promised.has_curve()) {
        throw std::invalid_argument("deciding_samples: rule: the filter hardware has the driver's "
                                    "weights and no deciding tap");
    }
    if (promised.returns_deciding_depth()) {
        return lookup;
    }
    require_taps(lookup, texels, map_depths);
    const PcfTaps taps{map_depths, rule};
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            scene::LookupSample& sample = lookup.samples[i];
            sample.map_depth = deciding_depth(taps, sample, texels[i]);
        }
    });
    return lookup;
}

bool can_derive_unbiased(const scene::Job& job, const scene::View& view)
{
    return scene::promises(job.lookup.filter).has_curve() && view.bias.normal_texels == 0;
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
    const float policy = rule.outside == Outside::shadowed ? infinity : -infinity;
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        ComparisonBlock block;
        for (std::size_t start = first; start < last; start += ComparisonBlock::size) {
            const std::size_t count = std::min(ComparisonBlock::size, last - start);
            block.fill(lookup.samples.data() + start, count, rule);
            block.guess();
            for (std::size_t i = 0; i < count; ++i) {
                result[start + i] = block.critical(i, lookup.samples[start + i].map_depth, policy);
            }
        }
    });
    return result;
}

} // namespace gnomon::analysis
