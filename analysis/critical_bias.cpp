#include "analysis/critical_bias.hpp"

#include "analysis/bias_order.hpp"
#include "analysis/pixel_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

using scene::Outside;
using scene::Vec2f;

constexpr float infinity = std::numeric_limits<float>::infinity();
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

/// Comparisons laid out for vector instructions.
class ComparisonBlock {
public:
    static constexpr std::size_t size = 256;

    void fill(const scene::LookupSample* samples, std::size_t count, const LookupRule& rule)
    {
        for (std::size_t i = 0; i < count; ++i) {
            set(i, make_comparison(samples[i].receiver_depth, samples[i].map_depth,
                                   rule.slope * samples[i].tan_theta, rule.reversed));
        }
    }
    void guess()
    {
        for (std::size_t i = 0; i < size; ++i) {
            guesses_[i] = guess_critical_bias(get(i));
        }
    }
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

    std::array<float, size> addends_{};
    std::array<float, size> thresholds_{};
    std::array<float, size> slope_terms_{};
    std::array<float, size> guesses_{};
};

/// Gathers the taps of a pcfK lookup as raster_gl/shaders/lookup.frag does.
class Taps {
public:
    Taps(const scene::Image<float>& map_depths, const LookupRule& rule)
        : map_{map_depths},
          clamps_{rule.outside == Outside::clamp},
          reversed_{rule.reversed},
          radius_{scene::filter_width_texels(rule.filter) / 2},
          last_{static_cast<float>(map_depths.size().width_px - 1)},
          // Farther than every depth, or nearer: a tap outside keeps its verdict whatever the bias.
          outside_{(rule.outside == Outside::lit) != rule.reversed ? infinity : -infinity}
    {
    }

    [[nodiscard]] float deciding_depth(const scene::LookupSample& sample, Vec2f texel) const
    {
        const Vec2f centre{std::floor(texel.x), std::floor(texel.y)};
        if (!clamps_ && policy_decides_all(sample, centre)) {
            return not_a_depth;
        }
        std::array<float, widest * widest> depths; // filled as far as it is read
        float* const last = gather(centre, depths.data());
        float* const middle = depths.data() + (last - depths.data()) / 2;
        std::nth_element(depths.data(), middle, last);
        return std::isinf(*middle) ? not_a_depth : *middle;
    }

private:
    static constexpr std::size_t widest = 9;

    /// Writes the depths of all taps to `out`, and returns their end.
    float* gather(Vec2f centre, float* out) const
    {
        const auto reach = static_cast<float>(radius_);
        const int width = 2 * radius_ + 1;
        const bool is_within = is_inside(centre - reach) && is_inside(centre + reach);
        for (int y = -radius_; y <= radius_; ++y) {
            if (is_within) {
                const int first = static_cast<int>(centre.x) - radius_;
                const int row = static_cast<int>(last_ - centre.y) + y;
                out = std::copy_n(&map_(first, row), width, out);
                continue;
            }
            for (int x = -radius_; x <= radius_; ++x) {
                *out++ = depth_at(centre + Vec2f{static_cast<float>(x), static_cast<float>(y)});
            }
        }
        return out;
    }

    /// Beyond far or behind a spot, where there are no taps. A spot's receivers behind it are
    /// beyond far by r, and where r rounds to the far plane, by a centre tap that is missing inside
    /// the map.
    [[nodiscard]] bool policy_decides_all(const scene::LookupSample& sample, Vec2f centre) const
    {
        const float r = sample.receiver_depth;
        const bool beyond_far = reversed_ ? !(r >= 0.0F) : !(r <= 1.0F);
        return beyond_far || (std::isnan(sample.map_depth) && is_inside(centre));
    }

    [[nodiscard]] bool is_inside(Vec2f texel) const
    {
        return texel.x >= 0.0F && texel.y >= 0.0F && texel.x <= last_ && texel.y <= last_;
    }

    [[nodiscard]] float depth_at(Vec2f texel) const
    {
        if (clamps_) {
            // In this order a NaN, of a receiver in the light's plane, becomes 0.
            texel.x = std::min(std::max(0.0F, texel.x), last_);
            texel.y = std::min(std::max(0.0F, texel.y), last_);
        } else if (!is_inside(texel)) {
            return outside_;
        }
        return map_(static_cast<int>(texel.x), static_cast<int>(last_ - texel.y));
    }

    const scene::Image<float>& map_;
    bool clamps_;
    bool reversed_;
    int radius_;
    float last_;
    float outside_;
};

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
    if (rule.filter == scene::Filter::hardware) {
        throw std::invalid_argument("deciding_samples: rule: the filter hardware has the driver's "
                                    "weights and no deciding tap");
    }
    if (rule.filter == scene::Filter::nearest || rule.filter == scene::Filter::linear) {
        return lookup;
    }
    require_taps(lookup, texels, map_depths);
    const Taps taps{map_depths, rule};
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            scene::LookupSample& sample = lookup.samples[i];
            sample.map_depth = taps.deciding_depth(sample, texels[i]);
        }
    });
    return lookup;
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
