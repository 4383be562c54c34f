#include "analysis/lookup/stored_taps.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

using scene::Texel;
using scene::Vec2f;

StoredTaps::StoredTaps(const scene::Image<float>& map_depths, const LookupRule& rule)
    : map_{map_depths},
      rule_{rule},
      footprint_{rule.promises, rule.outside, map_depths.size().width_px}
{
}

std::span<float> StoredTaps::gather(const scene::LookupSample& sample, Vec2f texel,
                                    std::span<float> out) const
{
    if (rule_.outside != scene::Outside::clamp && border_decides_all(sample, texel)) {
        return {};
    }
    // The map's rows are counted from the top, texels from the bottom.
    const int last = map_.size().height_px - 1;
    float* next = out.data();
    if (const auto first = footprint_.first_if_on_map(texel)) {
        const int width = footprint_.width_texels();
        for (int y = 0; y < width; ++y) {
            next = std::copy_n(&map_(first->x, last - first->y - y), width, next);
        }
    } else {
        footprint_.visit_taps(texel, [&](const Tap& tap) {
            *next++ = tap.is_inside ? map_(tap.texel.x, last - tap.texel.y) : rule_.outside_depth();
        });
    }
    return {out.data(), next};
}

/// A spot's receivers behind it are beyond far by r, and where r rounds to the far plane, by a
/// centre tap that is missing inside the map.
bool StoredTaps::border_decides_all(const scene::LookupSample& sample, Vec2f texel) const
{
    return rule_.is_beyond_far(sample.receiver_depth) ||
           (std::isnan(sample.map_depth) && footprint_.is_inside(texel));
}

} // namespace gnomon::analysis
