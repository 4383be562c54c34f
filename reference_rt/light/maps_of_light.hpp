#pragma once

#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "scene/light/exact_light.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::reference_rt {

/// The texel rays and the depths of each of a light's maps, by index.
struct MapsOfLight {
    /// @param view   must outlive it.
    /// @param place  of each texel, that its ray goes through.
    MapsOfLight(const scene::View& view, int resolution_texels,
                const scene::Vec2d& place = scene::texel_centre)
    {
        for (const scene::LightFrustum& map : view.maps) {
            rays.emplace_back(map, view.light, resolution_texels, place);
            depths.emplace_back(map);
        }
    }

    std::vector<TexelRays> rays;
    std::vector<LightDepth> depths;
};

} // namespace gnomon::reference_rt
