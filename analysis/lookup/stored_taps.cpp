#include "analysis/lookup/stored_taps.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

using scene::MapPoint;

StoredTaps::StoredTaps(const scene::Image<float>& map_depths, const LookupRule& rule)
    : map_depths_{map_depths},
      rule_{rule},
      footprint_{rule.traits, rule.edge(), map_depths.size().width_px}
{
}

std::span<float> StoredTaps::gather(const scene::LookupSample& sample, const MapPoint& at,
                                    std::span<float> out) const
{
    if (rule_.outside != scene::Outside::clamp && border_decides_all(sample, at)) {
        return {};
    }
    float* next = out.data();
    if (const auto first = footprint_.first_if_on_map(at)) {
        const int width = footprint_.width_texels();
        for (int y = 0; y < width; ++y) {
            const scene::Texel row{first->x, first->y + y, first->map};
            next = std::copy_n(&at_texel(map_depths_, row), width, next);
        }
    } else {
        footprint_.visit_taps(at, [&](const Tap& tap) {
            *next++ = tap.is_inside ? at_texel(map_depths_, tap.texel) : rule_.outside_depth();
        });
    }
    return {out.data(), next};
}

/// A spot's receivers behind it are beyond far by r, and where r rounds to the far plane, by a
/// centre tap that is missing inside the map.
bool StoredTaps::border_decides_all(const scene::LookupSample& sample, const MapPoint& at) const
{
    return rule_.is_beyond_far(sample.receiver_depth) ||
           (std::isnan(sample.map_depth) && footprint_.is_inside(at));
}

} // namespace gnomon::analysis
