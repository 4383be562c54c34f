#pragma once

#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/light_distance.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "renderers/light_queries.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::reference_rt {

/// The texel rays, and what is stored, of each of a light's maps, by index.
struct MapsOfLight {
    /// @param view   must outlive it.
    /// @param place  of each texel, that its ray goes through.
    MapsOfLight(const scene::View& view, int resolution_texels,
                const scene::Vec2d& place = scene::texel_centre)
    {
        for (const scene::LightFrustum& map : view.maps) {
            rays.emplace_back(map, view.light, resolution_texels, place);
            depths.emplace_back(map);
            if (!traits_of(map.content).is_gl_depth()) {
                distances.emplace_back(map);
            }
        }
    }

    /// What the map stores in place of depths, or nullptr.
    [[nodiscard]] const LightDistance* distance(std::size_t map) const
    {
        return distances.empty() ? nullptr : &distances[map];
    }

    std::vector<TexelRays> rays;
    std::vector<LightDepth> depths;
    std::vector<LightDistance> distances; ///< empty where maps hold depths
};

} // namespace gnomon::reference_rt
