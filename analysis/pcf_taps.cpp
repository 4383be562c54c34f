#include "analysis/pcf_taps.hpp"

#include "scene/infinity.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

using scene::infinity;
using scene::Outside;
using scene::Vec2f;

namespace {

} // namespace

PcfTaps::PcfTaps(const scene::Image<float>& map_depths, const LookupRule& rule)
    : map_{map_depths},
      clamps_{rule.outside == Outside::clamp},
      reversed_{rule.reversed},
      radius_{scene::filter_width_texels(rule.filter) / 2},
      last_{static_cast<float>(map_depths.size().width_px - 1)},
      outside_{(rule.outside == Outside::lit) != rule.reversed ? infinity : -infinity}
{
}

std::span<float> PcfTaps::gather(const scene::LookupSample& sample, Vec2f texel,
                                 std::span<float> out) const
{
    const Vec2f centre{std::floor(texel.x), std::floor(texel.y)};
    if (!clamps_ && policy_decides_all(sample, centre)) {
        return {};
    }
    return {out.data(), write(centre, out.data())};
}

float* PcfTaps::write(Vec2f centre, float* out) const
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

/// A spot's receivers behind it are beyond far by r, and where r rounds to the far plane, by a
/// centre tap that is missing inside the map.
bool PcfTaps::policy_decides_all(const scene::LookupSample& sample, Vec2f centre) const
{
    const float r = sample.receiver_depth;
    const bool beyond_far = reversed_ ? !(r >= 0.0F) : !(r <= 1.0F);
    return beyond_far || (std::isnan(sample.map_depth) && is_inside(centre));
}

bool PcfTaps::is_inside(Vec2f texel) const
{
    return texel.x >= 0.0F && texel.y >= 0.0F && texel.x <= last_ && texel.y <= last_;
}

float PcfTaps::depth_at(Vec2f texel) const
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

} // namespace gnomon::analysis
