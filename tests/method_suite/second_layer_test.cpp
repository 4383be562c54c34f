// Maps of two layers against closed forms.

#include "compared.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

/// A plane over x and z from −2.5 to 2.5 m that rises along both.
struct Slope {
    double along_x = 0;
    double along_z = 0;
    double height_m = 0; ///< in its middle
};

void add_slope(scene::SceneBuilder& builder, const std::string& name, const Slope& slope)
{
    const auto corner = [&](double x, double z) {
        return scene::Vec3d{x, slope.height_m + slope.along_x * x + slope.along_z * z, z};
    };
    const std::array<scene::Vec3d, 4> corners{corner(-2.5, -2.5), corner(-2.5, 2.5),
                                              corner(2.5, 2.5), corner(2.5, -2.5)};
    const std::array<std::array<std::uint32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
    builder.add(name, corners, triangles);
}

/// Two planes at a given distance.
scene::SceneFile two_planes(const Slope& upper, double thickness_m)
{
    scene::SceneBuilder builder;
    add_slope(builder, "upper", upper);
    add_slope(builder, "lower", {upper.along_x, upper.along_z, upper.height_m - thickness_m});
    return {builder.take(), {}};
}

/// Seen from above in so many pixels, in texels of 1/8 m.
scene::Job looking_down_finely(const std::vector<scene::Override>& keys)
{
    scene::Job job = looking_down(job_of_builtin("wall", with({{"method.name", "second_layer"},
                                                               {"lookup.outside", "clamp"},
                                                               {"bias.constant", "0"},
                                                               {"bias.slope", "0"},
                                                               {"bias.normal_texels", "0"}},
                                                              keys)));
    job.image = {512, 512};
    return job;
}

/// The number of shadowed pixels near the middle, all of which show the lit upper plane.
std::size_t shadowed_pixels(const Slope& upper, double thickness_m,
                            const std::vector<scene::Override>& keys)
{
    MethodCase c{looking_down_finely(keys), two_planes(upper, thickness_m)};
    c.draw_map();
    const auto samples = c.look_up(0).samples;
    std::size_t shadowed = 0;
    for (int y = 128; y < 384; ++y) {
        for (int x = 128; x < 384; ++x) {
            shadowed += samples(x, y).verdict < 0.5F ? 1U : 0U;
        }
    }
    return shadowed;
}

/// r minus the middle is g · (p − c) − (z₂ − z₁) / 2, with the receiver's position p and the
/// texel's centre c. With eight pixels across a texel they are at most 7/16 apart along each axis.
TEST(Midpoint, IsFreeOfAcneIffHalfTheGapIsMoreThanTheDepthAcrossATexel)
{
    GNOMON_REQUIRE_GL();
    constexpr double texel_m = 0.125;
    for (const auto& [x, z] : {std::pair{0.5, 0.0}, {0.25, 0.75}, {-1.0, 0.5}}) {
        const Slope upper{x, z, 4};
        const double needed_m = 2 * 7 / 16.0 * (std::abs(x) + std::abs(z)) * texel_m;
        EXPECT_EQ(shadowed_pixels(upper, 1.01 * needed_m, {}), 0U) << x << ' ' << z;
        EXPECT_GT(shadowed_pixels(upper, 0.95 * needed_m, {}), 0U) << x << ' ' << z;
    }
}

TEST(DualLayers, ShiftNoFartherThanTheirLimit)
{
    GNOMON_REQUIRE_GL();
    const Slope upper{0.5, 0.25, 4};
    const double needed_m = 7 / 16.0 * 0.75 * 0.125; // and the planes are 1 m apart
    for (const double factor : {0.95, 1.01}) {
        const std::vector<scene::Override> keys{
            {"method.compared", "dual"},
            {"method.largest_offset", fmt::format("{}", factor * needed_m / 8)}};
        const std::size_t shadowed = shadowed_pixels(upper, 1, keys);
        if (factor > 1) {
            EXPECT_EQ(shadowed, 0U);
        } else {
            EXPECT_GT(shadowed, 0U);
        }
    }
}

TEST(SecondDepth, LightsWhatLiesBetweenTheLayers)
{
    GNOMON_REQUIRE_GL();
    EXPECT_EQ(shadowed_pixels({0.5, 0.25, 4}, 0.2, {{"method.compared", "second"}}), 0U);
}

TEST(SecondLayers, AreTheFarPlaneWhereNothingLiesBehind)
{
    GNOMON_REQUIRE_GL();
    for (const char* const compared : {"midpoint", "second"}) {
        MethodCase c{looking_down_finely({{"method.compared", compared}}),
                     plates_over_ground({{-1, 1, -1, 1, 2}})};
        c.draw_map();
        // Only the plate casts. The ground lies beyond the middle between plate and far plane.
        const auto samples = c.look_up(0).samples;
        EXPECT_EQ(samples(256, 256).verdict, std::string{compared} == "second" ? 1 : 0);
        EXPECT_EQ(samples(20, 20).verdict, 1);
    }
}

TEST(SecondLayers, RefuseInOneLineWhatRemovesOne)
{
    const auto refusal = [](const std::vector<scene::Override>& keys) -> std::string {
        try {
            methods::check(
                job_of_builtin("sphere-cube", with({{"method.name", "second_layer"}}, keys)));
        } catch (const scene::InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal({{"shadow_map.depth_format", "d32f"}}), "");
    EXPECT_EQ(refusal({{"shadow_map.cull", "front"}}),
              "shadow_map.cull = \"front\": removes one of the two surfaces that method.name = "
              "\"second_layer\" needs; remove it");
    EXPECT_EQ(refusal({{"shadow_map.depth_format", "d16"}}),
              "shadow_map.depth_format = \"d16\": method.name = \"second_layer\" "
              "separates its layers by unrounded depths; use d32f");
}

} // namespace
} // namespace gnomon::tests
