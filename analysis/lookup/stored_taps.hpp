#pragma once

#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "scene/image.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <span>

namespace gnomon::analysis {

/// The stored depths that a lookup reads, as raster_gl/shaders/lookup.frag does.
class StoredTaps {
public:
    /// @param map_depths  As shaders see them (`scene::maps_image_size`); must outlive this.
    StoredTaps(const scene::Image<float>& map_depths, const LookupRule& rule);

    /// Writes the depths of the footprint to `out`; a tap outside the map has the rule's
    /// `outside_depth`.
    /// @param at     where the lookup reads.
    /// @param out    As long as there are taps.
    /// @return  What was written; empty where the border mode decides for all taps: beyond far, or
    ///          behind a spot.
    [[nodiscard]] std::span<float> gather(const scene::LookupSample& sample,
                                          const scene::MapPoint& at, std::span<float> out) const;

private:
    [[nodiscard]] bool border_decides_all(const scene::LookupSample& sample,
                                          const scene::MapPoint& at) const;

    const scene::Image<float>& map_depths_;
    LookupRule rule_;
    Footprint footprint_;
};

} // namespace gnomon::analysis
