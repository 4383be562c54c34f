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
constexpr std::size_t pixels_per_task = 16384;

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

float float_below(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    if (x == 0.0F) {
        return -std::numeric_limits<float>::denorm_min();
    }
    return std::bit_cast<float>(x > 0.0F ? bits - 1 : bits + 1);
}

float float_above(float x)
{
    return -float_below(-x);
}

/// The smallest float32 y with fl(y + addend) >= target, unless the doubles here round.
float guess_summand(float addend, float target)
{
    // What lies above the midpoint below the target rounds to it or beyond; the midpoint itself
    // rounds to whichever neighbour is even.
    const double midpoint = 0.5 * (double{target} + double{float_below(target)});
    constexpr double largest =
        0x1p126; // stays away from the ends, where a guess would prove nothing
    const double least = std::clamp(midpoint - double{addend}, -largest, largest);
    const auto y = static_cast<float>(least);
    const bool is_odd = (std::bit_cast<std::uint32_t>(target) & 1) != 0;
    const bool is_too_small = double{y} < least || (is_odd && double{y} == least);
    return is_too_small ? float_above(y) : y;
}

/// The smallest bias that is not below x.
float bias_from(float x)
{
    constexpr float smallest_normal = std::numeric_limits<float>::min();
    if (std::abs(x) < smallest_normal) {
        return x > 0.0F ? smallest_normal : 0.0F;
    }
    return x;
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

float critical_bias(const Comparison& comparison)
{
    const float sum = guess_summand(comparison.addend, comparison.threshold);
    const float guess = bias_from(guess_summand(comparison.slope_term, sum));
    if (comparison.is_lit(guess) && !comparison.is_lit(previous_bias(guess))) [[likely]] {
        return guess;
    }
    return search_critical_bias(comparison);
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

template <typename Run>
void for_each_pixel(std::size_t pixel_count, const Run& run)
{
    tbb::parallel_for(tbb::blocked_range<std::size_t>{0, pixel_count, pixels_per_task},
                      [&](const tbb::blocked_range<std::size_t>& pixels) {
                          for (std::size_t i = pixels.begin(); i != pixels.end(); ++i) {
                              run(i);
                          }
                      });
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
    return critical_bias(Comparison{r, d, slope_term, reversed});
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
    for_each_pixel(lookup.samples.pixel_count(), [&](std::size_t i) {
        result.samples[i].map_depth = taps.deciding_depth(lookup.samples[i], texels[i]);
    });
    return result;
}

scene::Image<float> critical_biases(const scene::LookupLayers& lookup, const LookupRule& rule)
{
    scene::Image<float> result{lookup.samples.size()};
    const float policy = rule.outside == Outside::shadowed ? infinity : -infinity;
    for_each_pixel(lookup.samples.pixel_count(), [&](std::size_t i) {
        const scene::LookupSample& sample = lookup.samples[i];
        result[i] = std::isnan(sample.map_depth)
                        ? policy
                        : critical_bias({sample.receiver_depth, sample.map_depth,
                                         rule.slope * sample.tan_theta, rule.reversed});
    });
    return result;
}

} // namespace gnomon::analysis
