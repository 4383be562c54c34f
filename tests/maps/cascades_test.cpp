// GLSL and C++ choose the same cascade. Between two cascades GL mixes their verdicts.

#include "chosen_maps.hpp"
#include "gl_case.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

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

TEST(TheCascade, IsTheSameInGlslToTheBit)
{
    GNOMON_REQUIRE_GL();
    std::size_t views = 0;
    PixelsOfMaps pixels;
    for (const char* builtin : {"sphere-plane", "columns", "yard", "terrain", "tilted-plane"}) {
        for (const char* split : {"uniform", "practical"}) {
            for (const char* select : {"view_depth", "containing"}) {
                const char* const reversed = views++ % 2 == 0 ? "false" : "true";
                SCOPED_TRACE(fmt::format("{} {} {}", builtin, split, select));
                GlCase c{builtin, cascade_keys({{"shadow_map.split", split},
                                                {"shadow_map.select", select},
                                                {"shadow_map.reversed", reversed}})};
                expect_chosen_maps(c, pixels);
            }
        }
    }
    EXPECT_EQ(pixels.size(), 4U);
    expect_all_chosen(pixels, 0.02);
}

/// The lookups of all pixels in one map, whichever map they would choose.
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
            // The shader's division and that of pcf err by 2.5 ulp, each product and sum by half.
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
        EXPECT_NEAR(length_m, 0.05, 0.05 * 3 * 0x1p-24); // three roundings
    }
    // The verdicts are those of a constant bias in depth units for each map.
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
