// GLSL and C++ choose the same map.

#include "chosen_maps.hpp"
#include "gl_case.hpp"
#include "quadrants.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

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
    PixelsOfMaps pixels;
    for (const Shown& shown : shown_views()) {
        GlCase c{shown.builtin, shown.keys};
        c.view = in_quadrants(c.view);
        SCOPED_TRACE(shown.builtin);
        expect_chosen_maps(c, pixels);
        const auto maps = c.lookup_pass.read().maps;
        const auto triangles = read_triangles(*shared_context(), *c.receivers);
        for (std::size_t i = 0; i < maps.pixel_count(); ++i) {
            EXPECT_TRUE(triangles[i] != scene::no_triangle || maps[i] == 0) << "pixel " << i;
        }
    }
    expect_all_chosen(pixels, 0.05);
}

} // namespace
} // namespace gnomon::tests
