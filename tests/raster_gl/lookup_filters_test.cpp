#include "gl_case.hpp"

#include "scene/job/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>

/// Filters whose weights the driver computes: properties that hold for every driver.
namespace gnomon::raster_gl {
namespace {

using tests::GlCase;

std::vector<scene::Override> keys(const char* filter, const char* reversed)
{
    return {{"image.width", "480"},
            {"image.height", "270"},
            {"shadow_map.resolution", "300"},
            {"shadow_map.depth_format", "d32f"},
            {"shadow_map.reversed", reversed},
            {"lookup.filter", filter},
            {"lookup.outside", "clamp"},
            {"bias.constant", "0.0007"}};
}

/// The four taps of a linear lookup and their fractions.
struct Footprint {
    std::array<float, 4> depth{}; ///< (0,0) (1,0) (0,1) (1,1)
    scene::Vec2f fraction{};

    [[nodiscard]] double bilinear() const
    {
        const double lower = std::lerp(double{depth[0]}, double{depth[1]}, double{fraction.x});
        const double upper = std::lerp(double{depth[2]}, double{depth[3]}, double{fraction.x});
        return std::lerp(lower, upper, double{fraction.y});
    }
};

Footprint footprint(const scene::Image<float>& map, const scene::Vec2f& texel)
{
    const int last = map.size().width_px - 1;
    const scene::Vec2f first{std::floor(texel.x - 0.5F), std::floor(texel.y - 0.5F)};
    Footprint result;
    result.fraction = texel - 0.5F - first;
    for (int i = 0; i < 4; ++i) {
        const int x = std::clamp(static_cast<int>(first.x) + i % 2, 0, last);
        const int y = std::clamp(static_cast<int>(first.y) + i / 2, 0, last);
        result.depth.at(static_cast<std::size_t>(i)) = map(x, last - y);
    }
    return result;
}

// Drivers may quantise the fractions to 8 bits (Vulkan's and D3D's minimum): 2^-9 of the spread.
constexpr double weight_error = 0x1p-8;

TEST(LinearLookup, InterpolatesDepthThenCompares)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"sphere-plane", "yard"}) {
        for (const char* reversed : {"false", "true"}) {
            GlCase c{scene, keys("linear", reversed)};
            c.draw_all();
            const auto map = read_shader_depths(*tests::shared_context(), *c.map);
            const auto samples = c.lookup_pass.read().samples;
            const auto texels = c.lookup_pass.read().texels;
            const auto triangles = read_triangles(*tests::shared_context(), *c.receivers);
            for (std::size_t i = 0; i < samples.pixel_count(); ++i) {
                if (triangles[i] == scene::no_triangle) {
                    continue;
                }
                const Footprint taps = footprint(map, texels[i]);
                const auto [low, high] = std::minmax_element(taps.depth.begin(), taps.depth.end());
                const float d = samples[i].map_depth;
                ASSERT_NEAR(d, taps.bilinear(), 2 * weight_error * double{*high - *low} + 0x1p-22)
                    << scene << " pixel " << i;
                const float r = samples[i].receiver_depth;
                const float b = c.view.bias.constant;
                ASSERT_EQ(samples[i].verdict == 1.0F, c.map->reversed ? r + b >= d : r - b <= d);
            }
        }
    }
}

TEST(HardwareLookup, WeighsTheFourComparisons)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"sphere-plane", "yard"}) {
        for (const char* reversed : {"false", "true"}) {
            GlCase c{scene, keys("hardware", reversed)};
            c.draw_all();
            const auto map = read_shader_depths(*tests::shared_context(), *c.map);
            const auto samples = c.lookup_pass.read().samples;
            const auto texels = c.lookup_pass.read().texels;
            const auto triangles = read_triangles(*tests::shared_context(), *c.receivers);
            std::size_t between = 0;
            for (std::size_t i = 0; i < samples.pixel_count(); ++i) {
                if (triangles[i] == scene::no_triangle) {
                    continue;
                }
                Footprint taps = footprint(map, texels[i]);
                const float r = samples[i].receiver_depth;
                const float b = c.view.bias.constant;
                for (float& d : taps.depth) {
                    d = (c.map->reversed ? r + b >= d : r - b <= d) ? 1.0F : 0.0F;
                }
                const double expected = taps.bilinear();
                ASSERT_NEAR(samples[i].verdict, expected, 2 * weight_error)
                    << scene << " reversed " << reversed << " pixel " << i;
                between += expected > 0.1 && expected < 0.9 ? 1 : 0;
            }
            EXPECT_GT(between, 100U) << "the scene must have soft edges for this to test anything";
        }
    }
}

TEST(FilteredLookup, AnswersTheBorderModeWhereTheWholeFootprintIsOutside)
{
    GNOMON_REQUIRE_GL();
    for (const char* filter : {"linear", "hardware"}) {
        for (const char* outside : {"lit", "shadowed"}) {
            GlCase c{"wall",
                     {{"image.width", "480"},
                      {"image.height", "270"},
                      {"shadow_map.resolution", "64"},
                      {"shadow_map.fit", "fixed"},
                      {"shadow_map.half_extent", "0.8"},
                      {"lookup.filter", filter},
                      {"lookup.outside", outside}}};
            c.draw_all();
            const auto samples = c.lookup_pass.read().samples;
            const auto texels = c.lookup_pass.read().texels;
            const auto triangles = read_triangles(*tests::shared_context(), *c.receivers);
            std::size_t beyond = 0;
            for (std::size_t i = 0; i < samples.pixel_count(); ++i) {
                const scene::Vec2f t = texels[i];
                const bool outside_footprint =
                    t.x < -0.5F || t.y < -0.5F || t.x >= 64.5F || t.y >= 64.5F;
                if (triangles[i] != scene::no_triangle && outside_footprint) {
                    ++beyond;
                    ASSERT_EQ(samples[i].verdict, std::string{outside} == "lit" ? 1.0F : 0.0F);
                }
            }
            EXPECT_GT(beyond, 1000U);
        }
    }
}

} // namespace
} // namespace gnomon::raster_gl
