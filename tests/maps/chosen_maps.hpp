#pragma once

#include "gl_case.hpp"
#include "raster_gl/readback.hpp"
#include "scene/light/map_choice.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <vector>

namespace gnomon::tests {

/// Calls `visit` with the index and the world position of each pixel that shows a surface.
template <typename Visit>
void visit_receivers(const GlCase& c, const Visit& visit)
{
    const auto triangles = read_triangles(*shared_context(), *c.receivers);
    const auto positions = read_world_positions(*shared_context(), *c.receivers);
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        if (triangles[i] != scene::no_triangle) {
            visit(i, scene::Vec3f{positions[i]});
        }
    }
}

/// The map that C++ chooses for a position.
inline std::size_t chosen_map_of(const GlCase& c, const scene::Vec3f& position)
{
    return chosen_map(c.view.maps, c.view.map_choice, c.view.slices, position);
}

/// Pixels by the map that they read.
using PixelsOfMaps = std::vector<std::size_t>;

/// Draws the case and expects GL to choose the same map as C++ in every pixel.
inline void expect_chosen_maps(GlCase& c, PixelsOfMaps& pixels)
{
    c.draw_all();
    const auto maps = c.lookup_pass.read().maps;
    ASSERT_EQ(maps.size(), c.view.image);
    pixels.resize(c.view.maps.size());
    std::size_t different = 0;
    visit_receivers(c, [&](std::size_t i, const scene::Vec3f& position) {
        const std::size_t expected = chosen_map_of(c, position);
        different += maps[i] != expected ? 1U : 0U;
        ++pixels.at(expected);
    });
    EXPECT_EQ(different, 0U);
}

/// Expects half a million pixels, of which each map has at least this share.
inline void expect_all_chosen(const PixelsOfMaps& pixels, double least_share)
{
    const auto all = std::accumulate(pixels.begin(), pixels.end(), std::size_t{0});
    EXPECT_GT(all, 500'000U);
    for (const std::size_t of_map : pixels) {
        EXPECT_GT(static_cast<double>(of_map), least_share * static_cast<double>(all));
    }
}

} // namespace gnomon::tests
