// Which of several maps a receiver reads: in GLSL as in C++.

#include "scene/light/map_choice.hpp"

#include "gl_case.hpp"
#include "quadrants.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

/// A view, by its scene and keys.
struct Shown {
    const char* builtin;
    std::vector<scene::Override> keys;
};

std::vector<Shown> shown_views()
{
    std::mt19937 random{20};
    std::uniform_real_distribution<double> degrees{-180, 180};
    std::vector<Shown> views;
    for (const char* builtin : {"sphere-plane", "columns", "yard", "tilted-plane", "terrain"}) {
        for (const bool is_reversed : {false, true}) {
            for (const bool is_turned : {false, true}) {
                views.push_back(
                    {builtin,
                     {{"shadow_map.reversed", is_reversed ? "true" : "false"},
                      {"shadow_map.roll_deg", is_turned ? std::to_string(degrees(random)) : "0"},
                      {"shadow_map.resolution", "64"},
                      {"lookup.position", "pixel"},
                      {"image.width", "320"},
                      {"image.height", "180"}}});
            }
        }
    }
    return views;
}

TEST(TheChosenMap, IsTheSameInGlslToTheBit)
{
    GNOMON_REQUIRE_GL();
    std::size_t compared = 0;
    std::array<std::size_t, 4> chosen_of_map{};
    for (const Shown& shown : shown_views()) {
        GlCase c{shown.builtin, shown.keys};
        c.view = in_quadrants(c.view);
        c.draw_all();
        const auto maps = c.lookup_pass.read().maps;
        const auto triangles = read_triangles(*shared_context(), *c.receivers);
        const auto positions = read_world_positions(*shared_context(), *c.receivers);
        ASSERT_EQ(maps.size(), c.view.image);
        for (std::size_t i = 0; i < maps.pixel_count(); ++i) {
            if (triangles[i] == scene::no_triangle) {
                EXPECT_EQ(maps[i], 0);
                continue;
            }
            const std::size_t expected = chosen_map(c.view.maps, c.view.map_choice, c.view.slices,
                                                    scene::Vec3f{positions[i]});
            ASSERT_EQ(maps[i], expected) << shown.builtin << ", pixel " << i;
            ++chosen_of_map.at(expected);
            ++compared;
        }
    }
    EXPECT_GT(compared, 500'000U);
    for (const std::size_t pixels : chosen_of_map) {
        EXPECT_GT(pixels, compared / 20); // all are asked for
    }
}

} // namespace
} // namespace gnomon::tests
