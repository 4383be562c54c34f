// Which cascade a receiver reads, in GLSL as in C++, and verdicts that are mixed of two.

#include "scene/light/map_choice.hpp"

#include "gl_case.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

std::vector<scene::Override> cascade_keys(std::vector<scene::Override> more)
{
    std::vector<scene::Override> keys{{"shadow_map.layout", "cascades"},
                                      {"light.type", "directional"},
                                      {"light.direction", "[0.4, -1, -0.3]"},
                                      {"shadow_map.resolution", "64"},
                                      {"image.width", "320"},
                                      {"image.height", "180"}};
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

/// The pixels that show something, with where they are.
template <typename Visit>
void visit_receivers(GlCase& c, const Visit& visit)
{
    const auto triangles = read_triangles(*shared_context(), *c.receivers);
    const auto positions = read_world_positions(*shared_context(), *c.receivers);
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        if (triangles[i] != scene::no_triangle) {
            visit(i, scene::Vec3f{positions[i]});
        }
    }
}

TEST(TheCascade, IsTheSameInGlslToTheBit)
{
    GNOMON_REQUIRE_GL();
    std::size_t views = 0;
    std::size_t compared = 0;
    std::array<std::size_t, 4> chosen_of_map{};
    for (const char* builtin : {"sphere-plane", "columns", "yard", "terrain", "tilted-plane"}) {
        for (const char* split : {"uniform", "practical"}) {
            for (const char* select : {"view_depth", "containing"}) {
                GlCase c{builtin, cascade_keys({{"shadow_map.split", split},
                                                {"shadow_map.select", select},
                                                {"shadow_map.reversed",
                                                 views % 2 == 0 ? "false" : "true"}})};
                c.draw_all();
                ++views;
                const auto maps = c.lookup_pass.read().maps;
                visit_receivers(c, [&](std::size_t i, const scene::Vec3f& position) {
                    const std::size_t expected =
                        chosen_map(c.view.maps, c.view.map_choice, c.view.slices, position);
                    ASSERT_EQ(maps[i], expected) << builtin << ", pixel " << i;
                    ++chosen_of_map.at(expected);
                    ++compared;
                });
            }
        }
    }
    EXPECT_EQ(views, 20U);
    EXPECT_GT(compared, 500'000U);
    for (const std::size_t pixels : chosen_of_map) {
        EXPECT_GT(pixels, compared / 50); // all are asked for
    }
}

/// The verdicts of all pixels that read this map, wherever they lie: as if it were chosen.
scene::LookupLayers lookup_in(GlCase& c, std::size_t map)
{
    const scene::ViewSlices slices = c.view.slices;
    c.view.slices.mixed_from.clear();
    constexpr float endless = 1e30F;
    for (std::size_t i = 0; i < slices.ends.size(); ++i) {
        c.view.slices.ends[i] = i < map ? -endless : endless;
    }
    c.look_up();
    c.view.slices = slices;
    return c.lookup_pass.read();
}

TEST(MixedVerdicts, AreThoseOfBothMapsByTheirShares)
{
    GNOMON_REQUIRE_GL();
    for (const char* filter : {"nearest", "linear", "hardware", "pcf3"}) {
        GlCase c{"terrain", cascade_keys({{"shadow_map.blend", "0.5"}, {"lookup.filter", filter}})};
        c.draw_all();
        const scene::LookupLayers mixed = c.lookup_pass.read();
        std::vector<scene::LookupLayers> of_maps;
        for (std::size_t map = 0; map < c.view.maps.size(); ++map) {
            of_maps.push_back(lookup_in(c, map));
        }
        std::size_t between = 0;
        visit_receivers(c, [&](std::size_t i, const scene::Vec3f& position) {
            const std::size_t own = c.view.slices.slice_of(position);
            const float depth_m = c.view.slices.view_depth_m(position);
            const float from_m = c.view.slices.mixed_from[own];
            const bool is_mixed = own + 1 < of_maps.size() && depth_m > from_m;
            ASSERT_EQ(mixed.next_at(i).has_value(), is_mixed) << i;
            const double share =
                is_mixed ? (depth_m - from_m) / (c.view.slices.ends[own] - from_m) : 0;
            const double a{of_maps[own].samples[i].verdict};
            const double b{is_mixed ? of_maps[own + 1].samples[i].verdict : 0.0F};
            // The shader's division errs by 2.5 ulp, the pcf's by as much, each product and sum by
            // half.
            ASSERT_NEAR(mixed.samples[i].verdict, (1 - share) * a + share * b, 8 * 0x1p-24) << i;
            between += a != b && is_mixed ? 1 : 0;
        });
        EXPECT_GT(between, 300U) << filter;
    }
}

TEST(BiasesInMetres, AreAsLongInEveryCascade)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"columns", cascade_keys({{"bias.constant_m", "0.05"}})};
    ASSERT_EQ(c.view.bias_scales.size(), 4U);
    EXPECT_EQ(c.view.bias_scales.front(), 1.0F);
    for (std::size_t i = 0; i < c.view.maps.size(); ++i) {
        const double length_m =
            double{c.view.bias.constant} * double{c.view.bias_scales[i]} * c.view.maps[i].range_m();
        EXPECT_NEAR(length_m, 0.05, 0.05 * 3 * 0x1p-24); // of three roundings
    }
    // As with a constant bias for each map alone.
    c.draw_all();
    const scene::LookupLayers in_metres = c.lookup_pass.read();
    const scene::View view = c.view;
    for (std::size_t map = 0; map < view.maps.size(); ++map) {
        c.view.bias.constant = view.bias.constant * view.bias_scales[map];
        c.view.bias_scales.clear();
        c.look_up();
        const scene::LookupLayers alone = c.lookup_pass.read();
        for (std::size_t i = 0; i < alone.maps.pixel_count(); ++i) {
            if (alone.maps[i] == map) {
                ASSERT_EQ(alone.samples[i].verdict, in_metres.samples[i].verdict) << i;
            }
        }
        c.view = view;
    }
}

} // namespace
} // namespace gnomon::tests
