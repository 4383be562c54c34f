#include "gl_case.hpp"

#include "scene/job/sweep/sweep.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>

/// Maps of light distance, linear from near to far.
namespace gnomon::raster_gl {
namespace {

using tests::GlCase;
using tests::shared_context;

std::vector<scene::Override> linear_keys(const char* position, const char* format)
{
    return {{"image.width", "320"},
            {"image.height", "180"},
            {"shadow_map.resolution", "256"},
            {"shadow_map.content", "linear"},
            {"shadow_map.depth_format", format},
            {"lookup.position", position},
            {"lookup.outside", "clamp"},
            {"bias.constant", "0"}};
}

// ζ is a sum of four products in float32, of coordinates up to 20 m: 7 · 2^-24 · 60 m, over a range
// of some metres; near, far and the quotient round once more each.
double allowed(const scene::LightFrustum& map)
{
    return (7 * 0x1p-24 * 60 + 4 * 0x1p-24 * map.far_m) / map.range_m();
}

TEST(LinearDepth, OfAReceiverIsItsLightDistanceFromNearToFar)
{
    GNOMON_REQUIRE_GL();
    for (const char* const position : {"vertex", "pixel"}) {
        GlCase c{"sphere-plane", linear_keys(position, "d32f")};
        c.draw_all();
        const scene::LightFrustum& map = c.view.first_map();
        const auto lookup = c.lookup_pass.read();
        const auto triangles = read_triangles(*shared_context(), *c.receivers);
        const auto positions = read_world_positions(*shared_context(), *c.receivers);
        std::size_t tried = 0;
        for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
            if (triangles[i] == scene::no_triangle) {
                continue;
            }
            const double light_distance_m = map.light_distance_m(scene::Vec3d{positions[i]});
            const double expected = (light_distance_m - map.near_m) / map.range_m();
            if (expected < 0 || expected > 1) {
                continue; // limited
            }
            ASSERT_NEAR(lookup.samples[i].receiver_depth, expected, allowed(map)) << position;
            ++tried;
        }
        EXPECT_GT(tried, 10'000U);
    }
}

// If the map shows the plane y = 0, the texel's ray meets it at a known light distance.
TEST(LinearDepth, OfTheMapIsThatOfWhatATexelSees)
{
    GNOMON_REQUIRE_GL();
    for (const char* const format : {"d32f", "d24", "r32f", "u20"}) {
        GlCase c{"sphere-plane", linear_keys("pixel", format)};
        c.draw_shadow_map();
        const scene::LightFrustum& map = c.view.first_map();
        const auto depths = read_shader_depths(*shared_context(), *c.map);
        std::size_t tried = 0;
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                const double u = (2 * (x + 0.5) / 256 - 1) * map.right_side;
                const double v = (1 - 2 * (y + 0.5) / 256) * map.top;
                const scene::Vec3d ray = map.forward + u * map.right + v * map.up;
                if (!(ray.y < 0)) {
                    continue;
                }
                const double ground_m = map.origin.y / -ray.y; // ζ: forward is unit
                const scene::Vec3d point = map.origin + ground_m * ray;
                // Inside the square of 20 m, outside the sphere's shadow.
                const bool is_seen =
                    std::abs(point.x) < 9.9 && std::abs(point.z) < 9.9 &&
                    glm::length(scene::Vec2d{point.x, point.z} - scene::Vec2d{2, 4}) > 6;
                const double expected = (ground_m - map.near_m) / map.range_m();
                if (is_seen && expected < 1) {
                    // The driver snaps corners, so that a plane's depth is off by its slope over
                    // 1/256 texel, some 1e-4 of the range at most, and formats by half a step.
                    ASSERT_NEAR(depths(x, y), expected, 1e-4) << format;
                    ++tried;
                }
            }
        }
        EXPECT_GT(tried, 3'000U) << format;
    }
}

// Verdicts depend on the order along equal rays. If back faces cast, and no surface shadows itself,
// they equal those of depths except where rounding decides.
TEST(LinearDepth, ShadowsWhatDepthsShadow)
{
    GNOMON_REQUIRE_GL();
    auto keys = linear_keys("pixel", "d32f");
    keys.push_back({"shadow_map.cull", "front"});
    GlCase linear{"sphere-plane", keys};
    linear.draw_all();
    std::erase_if(keys, [](const scene::Override& key) { return key.key == "shadow_map.content"; });
    GlCase depths{"sphere-plane", keys};
    depths.draw_all();
    const auto a = linear.lookup_pass.read();
    const auto b = depths.lookup_pass.read();
    const auto triangles = read_triangles(*shared_context(), *linear.receivers);
    std::size_t different = 0;
    std::size_t shadowed = 0;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        if (triangles[i] != scene::no_triangle) {
            different += a.samples[i].verdict != b.samples[i].verdict ? 1U : 0U;
            shadowed += b.samples[i].verdict == 0 ? 1U : 0U;
        }
    }
    EXPECT_GT(shadowed, 1'000U);
    EXPECT_LT(different, shadowed / 100);
}

} // namespace
} // namespace gnomon::raster_gl
