#pragma once

#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/light_distance.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "renderers/light_queries.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

namespace gnomon::reference_rt {

/// The texel rays and stored depths or distances of each of a light's maps.
struct MapsOfLight {
    /// @param view   must outlive this object.
    /// @param place  position in each texel that its ray passes through.
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

    /// The distance that the map stores instead of depths, or null.
    [[nodiscard]] const LightDistance* distance(std::size_t map) const
    {
        return distances.empty() ? nullptr : &distances[map];
    }

    std::vector<TexelRays> rays;
    std::vector<LightDepth> depths;
    std::vector<LightDistance> distances; ///< empty if maps store depths
};

/// Rejects queries about texels outside a map or triangles outside the scene.
class QueryChecks {
public:
    /// @param triangles, maps must outlive this object.
    /// @param map  index of the queried map.
    QueryChecks(const scene::TriangleScene& triangles, const MapsOfLight& maps, int map)
        : triangles_{triangles},
          maps_{maps},
          map_{map}
    {
    }

    /// @throws std::invalid_argument  as all checks here.
    void texel(const scene::Texel& texel) const { check(texel, map_); }
    void triangle(std::uint32_t triangle) const
    {
        if (triangle >= triangles_.triangles.size()) {
            throw std::invalid_argument{
                fmt::format("LightQueries: triangle {} is not in the scene", triangle)};
        }
    }
    void taps(const renderers::NearestQuery& query) const { tap(query.tap); }
    void taps(const renderers::LinearQuery& query) const
    {
        for (const renderers::ExactTap& of_four : query.taps) {
            tap(of_four);
        }
    }

private:
    void tap(const renderers::ExactTap& tap) const
    {
        if (tap.triangle != scene::no_triangle) {
            check(tap.texel, tap.texel.map); // beyond a cube's seams, taps are in other maps
            triangle(tap.triangle);
        }
    }
    void check(const scene::Texel& texel, int map) const
    {
        const int n = maps_.rays.front().resolution_texels();
        const bool is_of_map =
            texel.map == map && map >= 0 && static_cast<std::size_t>(map) < maps_.rays.size();
        if (!is_of_map || texel.x < 0 || texel.y < 0 || texel.x >= n || texel.y >= n) {
            throw std::invalid_argument{
                fmt::format("LightQueries: texel ({}, {}) of map {} is outside map {} of {} texels",
                            texel.x, texel.y, texel.map, map, n)};
        }
    }

    const scene::TriangleScene& triangles_;
    const MapsOfLight& maps_;
    int map_;
};

/// Combines the queries of a light's maps: a query goes to its texel's map, or to the map that its
/// pixel reads. The first map finds blockers, as light distances do not depend on the map.
/// @param maps  by index; a single one is returned as is.
/// @throws std::invalid_argument  if there is no map or more than `most_maps`. The result's methods
///                                throw it for an invalid map.
[[nodiscard]] std::unique_ptr<renderers::LightQueries>
shadow_map_rays(std::vector<std::unique_ptr<renderers::LightQueries>> maps);

} // namespace gnomon::reference_rt
