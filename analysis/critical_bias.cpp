#include "analysis/critical_bias.hpp"

#include "analysis/bias_order.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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
constexpr std::size_t pixels_per_task = 4096; // so few that both loops over them hit the cache

/// The lookup's comparison, both depth directions in one form: negating both sides of
/// fl(r − y) <= d gives fl(y − r) >= −d, for rounding is symmetric.
struct Comparison {
    float addend;
    float threshold;
    float slope_term;

    Comparison(float r, float d, float s, bool reversed)
        : addend{reversed ? r : -r},
          threshold{reversed ? d : -d},
          slope_term{s}
    {
    }
    [[nodiscard]] bool is_lit(float bias) const
    {
        const float whole = bias + slope_term;
        return whole + addend >= threshold;
    }
};

/// The float below x, or above it, for x other than 0; without branches, so that loops over pixels
/// become vector instructions.
float float_below(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(bits + 2 * (bits >> 31) - 1);
}

float stepped_up(float x, bool steps)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t step = steps ? 1 : 0;
    return std::bit_cast<float>((bits >> 31) != 0 ? bits - step : bits + step);
}

/// The smallest float32 y with fl(y + addend) >= target, unless the doubles here round.
float guess_summand(float addend, float target)
{
    // What lies above the midpoint below the target rounds to it or beyond; the midpoint itself
    // rounds to whichever neighbour is even.
    constexpr float below_zero = -std::numeric_limits<float>::denorm_min();
    const float below = target == 0.0F ? below_zero : float_below(target);
    const double least = 0.5 * (double{target} + double{below}) - double{addend};
    const auto y = static_cast<float>(least);
    const bool is_odd = (std::bit_cast<std::uint32_t>(target) & 1) != 0;
    return stepped_up(y, (double{y} < least) | (is_odd & (double{y} == least)));
}

/// The smallest bias that is not below x.
float bias_from(float x)
{
    constexpr float smallest_normal = std::numeric_limits<float>::min();
    const float beside_zero = x > 0.0F ? smallest_normal : 0.0F;
    return std::abs(x) < smallest_normal ? beside_zero : x;
}

/// Nearly always the critical bias: `is_right` tells.
struct Guess {
    float bias;
    bool is_right;

    explicit Guess(const Comparison& comparison)
    {
        constexpr float smallest_normal = std::numeric_limits<float>::min();
        const float sum = guess_summand(comparison.addend, comparison.threshold);
        bias = bias_from(guess_summand(comparison.slope_term, sum));
        // Below the smallest normal this tries a subnormal: then a right guess may be doubted.
        const float below = bias == 0.0F ? -smallest_normal : float_below(bias);
        is_right = (std::abs(bias) < largest) & comparison.is_lit(bias) & !comparison.is_lit(below);
    }

private:
    /// Beyond, a guess may stand at the end of the floats and prove nothing.
    static constexpr float largest = 0x1p126F;
};

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
        std::array<float, widest * widest> depths{};
        std::size_t count = 0;
        for (int y = -radius_; y <= radius_; ++y) {
            for (int x = -radius_; x <= radius_; ++x) {
                depths.at(count++) =
                    depth_at({centre.x + static_cast<float>(x), centre.y + static_cast<float>(y)});
            }
        }
        const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(count / 2);
        std::nth_element(depths.begin(), middle,
                         depths.begin() + static_cast<std::ptrdiff_t>(count));
        return std::isinf(*middle) ? not_a_depth : *middle;
    }

private:
    static constexpr std::size_t widest = 9;

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

/// Calls `run(first, last)` for runs of pixels, several at the same time.
template <typename Run>
void for_each_run(std::size_t pixel_count, const Run& run)
{
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>{0, pixel_count, pixels_per_task},
        [&](const tbb::blocked_range<std::size_t>& pixels) { run(pixels.begin(), pixels.end()); });
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
    const Comparison comparison{r, d, slope_term, reversed};
    const Guess guess{comparison};
    return guess.is_right ? guess.bias : search_critical_bias(comparison);
}

LookupRule lookup_rule(const scene::Job& job, const scene::View& view)
{
    return {job.lookup.filter, job.lookup.outside, view.frustum.reversed, view.bias.slope};
}

scene::LookupLayers deciding_samples(const scene::LookupLayers& lookup,
                                     const scene::Image<Vec2f>& texels,
                                     const scene::Image<float>& map_depths, const LookupRule& rule)
{
    if (rule.filter == scene::Filter::hardware) {
        throw std::invalid_argument("deciding_samples: rule: the filter hardware has the driver's "
                                    "weights and no deciding tap");
    }
    scene::LookupLayers result = lookup;
    if (rule.filter == scene::Filter::nearest || rule.filter == scene::Filter::linear) {
        return result;
    }
    require_taps(lookup, texels, map_depths);
    const Taps taps{map_depths, rule};
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            result.samples[i].map_depth = taps.deciding_depth(lookup.samples[i], texels[i]);
        }
    });
    return result;
}

scene::Image<float> critical_biases(const scene::LookupLayers& lookup, const LookupRule& rule)
{
    scene::Image<float> result{lookup.samples.size()};
    const auto comparison = [&](std::size_t i) {
        const scene::LookupSample& sample = lookup.samples[i];
        return Comparison{sample.receiver_depth, sample.map_depth, rule.slope * sample.tan_theta,
                          rule.reversed};
    };
    const float policy = rule.outside == Outside::shadowed ? infinity : -infinity;
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        // Two loops: the first without branches, the second for the few that it leaves as NaN.
        for (std::size_t i = first; i != last; ++i) {
            const Guess guess{comparison(i)};
            result[i] = guess.is_right ? guess.bias : not_a_depth;
        }
        for (std::size_t i = first; i != last; ++i) {
            if (std::isnan(result[i])) [[unlikely]] {
                result[i] = std::isnan(lookup.samples[i].map_depth)
                                ? policy
                                : search_critical_bias(comparison(i));
            }
        }
    });
    return result;
}

} // namespace gnomon::analysis
