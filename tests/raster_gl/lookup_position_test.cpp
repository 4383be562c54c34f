#include "gl_case.hpp"

#include "scene/job/sweep/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

/// Light clip positions computed per pixel from GL's interpolated world position.
namespace gnomon::raster_gl {
namespace {

using tests::GlCase;

std::vector<scene::Override> of_pixel(const char* reversed)
{
    return {{"image.width", "320"},
            {"image.height", "180"},
            {"shadow_map.resolution", "256"},
            {"shadow_map.depth_format", "d32f"},
            {"shadow_map.reversed", reversed},
            {"lookup.outside", "clamp"},
            {"lookup.position", "pixel"},
            {"bias.constant", "0.001"}};
}

/// A component of M·P, with a float32 error bound: four products and three sums are rounded, each
/// at most the sum of the absolute products.
struct Component {
    double value = 0;
    double error = 0;
};

Component component(const scene::Mat4f& m, const scene::Vec4f& p, int row)
{
    Component result;
    double all = 0;
    for (int column = 0; column < 4; ++column) {
        const double product = double{m[column][row]} * double{p[column]};
        result.value += product;
        all += std::abs(product);
    }
    result.error = 7 * 0x1p-24 * all;
    return result;
}

/// a / w, with a float32 error bound to first order: 4 ulp for the division, halving and adding one
/// half.
Component quotient(const Component& a, const Component& w)
{
    const double value = a.value / w.value;
    return {value, (a.error + std::abs(value) * w.error) / std::abs(w.value) +
                       4 * 0x1p-24 * (1 + std::abs(value))};
}

TEST(LookupPosition, OfThePixelIsTheMatrixTimesItsWorldPosition)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"sphere-plane", "yard"}) { // a spot and a directional light
        for (const char* reversed : {"false", "true"}) {
            GlCase c{scene, of_pixel(reversed)};
            c.draw_all();
            const auto triangles = read_triangles(*tests::shared_context(), *c.receivers);
            const auto positions = read_world_positions(*tests::shared_context(), *c.receivers);
            const auto lookup = c.lookup_pass.read();
            const scene::Mat4f& m = c.view.first_map().light_clip_from_world;
            std::size_t receivers = 0;
            for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
                const Component w = component(m, positions[i], 3);
                if (triangles[i] == scene::no_triangle || !(w.value > 0)) {
                    continue;
                }
                ++receivers;
                const Component z = quotient(component(m, positions[i], 2), w);
                const Component x = quotient(component(m, positions[i], 0), w);
                const double r = c.map->reversed ? z.value : 0.5 * z.value + 0.5;
                ASSERT_NEAR(lookup.samples[i].receiver_depth, std::clamp(r, 0.0, 1.0), z.error)
                    << scene << " reversed " << reversed << " pixel " << i;
                ASSERT_NEAR(lookup.texels[i].x, (0.5 * x.value + 0.5) * 256, 256 * x.error)
                    << scene << " reversed " << reversed << " pixel " << i;
            }
            EXPECT_GT(receivers, 10000U) << scene;
        }
    }
}

TEST(LookupPosition, OfThePixelNeedsNoReceiversOfItsLightMatrix)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"sphere-plane", "yard"}) {
        GlCase c{scene, of_pixel("false")};
        c.draw_all();
        const auto own = c.lookup_pass.read();
        const scene::View view = c.view;
        auto rolled = of_pixel("false");
        rolled.push_back({"shadow_map.roll_deg", "30"});
        c.set(rolled);
        c.draw_receivers();
        c.view = view;
        c.look_up();
        const auto others = c.lookup_pass.read();
        for (std::size_t i = 0; i < own.texels.pixel_count(); ++i) {
            ASSERT_EQ(own.samples[i].receiver_depth, others.samples[i].receiver_depth) << i;
            ASSERT_EQ(own.texels[i], others.texels[i]) << i;
            ASSERT_EQ(own.samples[i].verdict, others.samples[i].verdict) << i;
        }
    }
}

TEST(LookupPosition, OfTheVertexIsInterpolated)
{
    GNOMON_REQUIRE_GL();
    // The two differ by rounding: the yard spans some 100 m, where a float32 is off by 4e-6 m, or
    // 1e-7 of the depth range, and interpolation adds up a few such errors. 1e-4 is far above that,
    // and far below what another matrix or triangle would give.
    auto keys = of_pixel("false");
    GlCase c{"yard", keys};
    c.draw_all();
    const auto of_pixels = c.lookup_pass.read();
    keys.push_back({"lookup.position", "vertex"});
    c.set(keys);
    c.draw_all();
    const auto of_vertices = c.lookup_pass.read();
    std::size_t different = 0;
    for (std::size_t i = 0; i < of_pixels.texels.pixel_count(); ++i) {
        const float r = of_pixels.samples[i].receiver_depth;
        different += r != of_vertices.samples[i].receiver_depth ? 1U : 0U;
        ASSERT_NEAR(r, of_vertices.samples[i].receiver_depth, 1e-4) << i;
    }
    EXPECT_GT(different, 0U);
}

} // namespace
} // namespace gnomon::raster_gl
