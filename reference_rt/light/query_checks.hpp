#pragma once

#include "reference_rt/light/maps_of_light.hpp"
#include "renderers/light_queries.hpp"
#include "scene/geometry/triangles.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace gnomon::reference_rt {

/// Refuses questions about what one of a light's maps, or the scene, does not have.
class QueryChecks {
public:
    /// @param triangles, maps  must outlive it.
    /// @param map  that is asked about.
    QueryChecks(const scene::TriangleScene& triangles, const MapsOfLight& maps, int map)
        : triangles_{triangles},
          maps_{maps},
          map_{map}
    {
    }

    /// @throws std::invalid_argument  as those below.
    void texel(const scene::Texel& texel) const { check(texel, map_); }
    void triangle(std::uint32_t triangle) const
    {
        if (triangle >= triangles_.triangles.size()) {
            throw std::invalid_argument{
                fmt::format("ExactLight: triangle {} is not in the scene", triangle)};
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
            check(tap.texel, tap.texel.map); // a cube's seams lead to other maps' texels
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
                fmt::format("ExactLight: texel ({}, {}) of map {} is outside map {} of {} texels",
                            texel.x, texel.y, texel.map, map, n)};
        }
    }

    const scene::TriangleScene& triangles_;
    const MapsOfLight& maps_;
    int map_;
};

} // namespace gnomon::reference_rt
