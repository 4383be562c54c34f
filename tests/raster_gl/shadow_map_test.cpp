#include "gl_case.hpp"

#include "raster_gl/map/map_texture.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace gnomon::raster_gl {
namespace {

using tests::GlCase;

/// floor(z·(2^n − 1) + ½) in integers: z = m·2^-k with m < 2^24.
std::uint32_t exact_code(float z, int bits)
{
    int exponent = 0;
    const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(z, &exponent), 24));
    const int k = 24 - exponent; // z = mantissa · 2^-k
    if (k > 62) {
        return 0; // below 2^-38: far under half a code
    }
    const std::uint64_t product = mantissa * ((std::uint64_t{1} << bits) - 1);
    return static_cast<std::uint32_t>((product + (std::uint64_t{1} << (k - 1))) >> k);
}

TEST(ExactCode, MatchesValuesDoneByHand)
{
    EXPECT_EQ(exact_code(0.0F, 8), 0U);
    EXPECT_EQ(exact_code(1.0F, 8), 255U);
    EXPECT_EQ(exact_code(0.5F, 8), 128U); // 127.5 + ½
    EXPECT_EQ(exact_code(1.0F, 24), 16777215U);
}

TEST(ShadowMap, UnormTexelsAreTheExactlyRoundedCodeOfTheirZ)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"columns", "sphere-plane"}) {
        GlCase c{scene};
        for (int bits = 8; bits <= 24; ++bits) {
            for (const char* reversed : {"false", "true"}) {
                c.set({{"shadow_map.depth_format", fmt::format("u{}", bits)},
                       {"shadow_map.resolution", "400"},
                       {"shadow_map.reversed", reversed}});
                c.draw_shadow_map();
                const auto codes = read_codes(*tests::shared_context(), *c.map);
                const auto z = read_unquantised_z(*tests::shared_context(), *c.map);
                const auto depths = read_shader_depths(*tests::shared_context(), *c.map);
                const double largest = std::ldexp(1.0, bits) - 1;
                for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
                    ASSERT_EQ(codes[i], exact_code(z[i], bits)) << scene << " u" << bits;
                    ASSERT_EQ(depths[i], static_cast<float>(codes[i] / largest));
                }
            }
        }
    }
}

TEST(ShadowMap, HasTheSameDepthsWhereCodesAreDropped)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"columns", {{"shadow_map.depth_format", "u12"}, {"shadow_map.resolution", "300"}}};
    c.draw_shadow_map();
    const auto kept = read_shader_depths(*tests::shared_context(), *c.map);
    ShadowMapPass pass{*tests::shared_context(), ConvertedCodes::dropped};
    const ShadowMap& map = pass.render(c.gpu, c.view.maps, c.job.shadow_map);
    const auto dropped = read_shader_depths(*tests::shared_context(), map);
    EXPECT_TRUE(std::equal(kept.begin(), kept.end(), dropped.begin(), dropped.end()));
    EXPECT_THROW((void)read_codes(*tests::shared_context(), map), std::invalid_argument);
    EXPECT_THROW((void)read_unquantised_z(*tests::shared_context(), map), std::invalid_argument);
}

TEST(ShadowMap, RowsDrawnAndReadAloneAreThoseOfTheWholeMap)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"columns", {{"shadow_map.depth_format", "d32f"}, {"shadow_map.resolution", "600"}}};
    c.draw_shadow_map();
    const auto whole = read_shader_depths(*tests::shared_context(), *c.map);
    for (const scene::TexelRows rows : {scene::TexelRows{0, 1}, {599, 1}, {100, 300}, {0, 600}}) {
        ShadowMapPass pass{*tests::shared_context()};
        const ShadowMap& map =
            pass.render(c.gpu, c.view.maps, c.job.shadow_map, Primitives::dropped, {}, rows);
        const auto part = read_shader_depths(*tests::shared_context(), map, rows);
        ASSERT_EQ(part.size(), whole.size());
        for (int y = 0; y < 600; ++y) {
            const int row = 599 - y; // from the lower edge
            const bool is_read = row >= rows.first && row < rows.first + rows.count;
            for (int x = 0; x < 600; ++x) {
                ASSERT_EQ(part(x, y), is_read ? whole(x, y) : 0.0F) << x << ", " << y;
            }
        }
        // A later draw of the pass is whole again.
        const ShadowMap& again = pass.render(c.gpu, c.view.maps, c.job.shadow_map);
        const auto depths = read_shader_depths(*tests::shared_context(), again);
        ASSERT_TRUE(std::equal(depths.begin(), depths.end(), whole.begin()));
    }
}

TEST(ShadowMap, ShaderDepthsAreTheCodesNormalised)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"columns"};
    for (const FormatSupport& format : query_depth_formats(*tests::shared_context())) {
        if (!format.supported) {
            continue;
        }
        c.set({{"shadow_map.depth_format", format.name}, {"shadow_map.resolution", "512"}});
        c.draw_shadow_map();
        const auto codes = read_codes(*tests::shared_context(), *c.map);
        const auto depths = read_shader_depths(*tests::shared_context(), *c.map);
        const int bits = c.map->format.bits;
        for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
            if (format.name == "d32f") {
                ASSERT_EQ(codes[i], std::bit_cast<std::uint32_t>(depths[i]));
                continue;
            }
            // Below 1 a rounding is at most 2^-25. Code to float32, reciprocal of 2^n − 1, and
            // their product: three, and a driver that truncates the code first adds a whole 2^-24.
            ASSERT_NEAR(depths[i], codes[i] / (std::ldexp(1.0, bits) - 1), 5 * 0x1p-25)
                << format.name << " texel " << i;
        }
    }
}

TEST(ShadowMap, IsTheSameBytesEachTime)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"yard"};
    c.draw_shadow_map();
    const auto first = read_codes(*tests::shared_context(), *c.map);
    c.draw_shadow_map();
    const auto second = read_codes(*tests::shared_context(), *c.map);
    EXPECT_TRUE(std::equal(first.begin(), first.end(), second.begin()));
}

TEST(ShadowMap, IsTheSameBytesAfterItWasForgotten)
{
    GNOMON_REQUIRE_GL();
    for (const char* resolution : {"256", "8192"}) { // a large one is let go of by a draw
        GlCase c{"columns", {{"shadow_map.resolution", resolution}}};
        c.draw_shadow_map();
        const auto first = read_shader_depths(*tests::shared_context(), *c.map);
        c.shadow_map_pass.forget();
        EXPECT_EQ(c.map->depth.name(), 0U);
        c.draw_shadow_map();
        const auto again = read_shader_depths(*tests::shared_context(), *c.map);
        EXPECT_TRUE(std::equal(first.begin(), first.end(), again.begin())) << resolution;
    }
}

TEST(ShadowMap, LeavesOutObjectsThatDoNotCast)
{
    GNOMON_REQUIRE_GL();
    GlCase whole{"sphere-plane"};
    std::string names;
    for (const auto& object : whole.file.scene.objects) {
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", object.name);
    }
    GlCase c{"sphere-plane", {{"scene.no_cast", fmt::format("[{}]", names)}}};
    c.draw_shadow_map();
    for (const float depth : read_shader_depths(*tests::shared_context(), *c.map)) {
        ASSERT_EQ(depth, 1.0F);
    }
}

/// Number of texels that something was drawn to.
std::size_t drawn_texels(GlCase& c, const std::string& cull)
{
    c.set({{"shadow_map.cull", cull}, {"shadow_map.depth_format", "d32f"}});
    c.draw_shadow_map();
    std::size_t count = 0;
    for (const float depth : read_shader_depths(*tests::shared_context(), *c.map)) {
        count += depth < 1.0F ? 1 : 0;
    }
    return count;
}

TEST(ShadowMap, CullsTheSideThatTheLightSees)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"tilted-plane"}; // its upper side faces the light
    const std::size_t all = drawn_texels(c, "none");
    EXPECT_GT(all, 0U);
    EXPECT_EQ(drawn_texels(c, "front"), 0U);
    EXPECT_EQ(drawn_texels(c, "back"), all);
}

TEST(ShadowMap, ReversedStoresOneMinusTheDepthOfAnOrthographicLight)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"yard"};
    c.set({{"shadow_map.resolution", "512"}, {"shadow_map.depth_format", "d32f"}});
    c.draw_shadow_map();
    const auto standard = read_shader_depths(*tests::shared_context(), *c.map);
    c.set({{"shadow_map.resolution", "512"},
           {"shadow_map.depth_format", "d32f"},
           {"shadow_map.reversed", "true"}});
    c.draw_shadow_map();
    const auto reversed = read_shader_depths(*tests::shared_context(), *c.map);
    for (std::size_t i = 0; i < standard.pixel_count(); ++i) {
        // Both matrices round their entries and products once each: a few times 2^-24, and the
        // plane evaluation from the framebuffer's origin (driver bound) stays below 64 · 2^-24.
        ASSERT_NEAR(standard[i], 1.0F - reversed[i], 64 * 0x1p-24) << "texel " << i;
    }
}

TEST(ShadowMap, RefusesAMapLargerThanTheDriverHolds)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"tilted-plane"};
    c.job.shadow_map.resolution_texels = 1 << 20;
    EXPECT_THROW(c.draw_shadow_map(), scene::InputError);
}

} // namespace
} // namespace gnomon::raster_gl
