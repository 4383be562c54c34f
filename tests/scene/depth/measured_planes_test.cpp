#include "scene/depth/measured_planes.hpp"

#include "scene/depth/raster_plane.hpp"
#include "scene/error.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace gnomon::scene {
namespace {

MeasuredPlaneSettings settings_of(Projection projection, int count, double tilt_deg = 0,
                                  double offset_m = 0)
{
    MeasuredPlaneSettings settings;
    settings.range = {projection, 4, 50, false, {}};
    settings.count = count;
    settings.tilt_rad = glm::radians(tilt_deg);
    settings.offset_m = offset_m;
    return settings;
}

constexpr Projection both_projections[] = {Projection::perspective, Projection::orthographic};

TEST(MeasuredPlanes, ThatFaceTheCameraLieAtTheirVerticesDistance)
{
    for (const Projection projection : both_projections) {
        for (const double offset_m : {0.0, 500.0}) {
            const MeasuredPlanes planes =
                make_measured_planes(settings_of(projection, 100, 0, offset_m));
            for (std::uint32_t i = 0; i < 100; ++i) {
                const double light_distance_m = offset_m - double{planes.triangles.corners(i)[0].z};
                // A quotient of doubles whose numerator is a multiple of its denominator.
                EXPECT_NEAR(planes.light_distance_m(i), light_distance_m, 1e-13 * light_distance_m);
            }
        }
    }
}

TEST(MeasuredPlanes, SpreadFromNearToFar)
{
    for (const Projection projection : both_projections) {
        const MeasuredPlanes planes = make_measured_planes(settings_of(projection, 1000));
        // Margins of 2^-22 of 54 m, and a float32 step at 50 m.
        EXPECT_NEAR(planes.light_distance_m(0), 4, 2e-5);
        EXPECT_NEAR(planes.light_distance_m(999), 50, 2e-5);
        for (std::size_t i = 0; i < 999; ++i) {
            EXPECT_GE(planes.light_distance_m(i), 4 + 0.046 * static_cast<double>(i) - 2e-5) << i;
            EXPECT_LE(planes.light_distance_m(i), 4 + 0.046 * static_cast<double>(i + 1) + 2e-5)
                << i;
        }
    }
}

TEST(MeasuredPlanes, AreTiltedAsAsked)
{
    for (const Projection projection : both_projections) {
        const MeasuredPlanes planes = make_measured_planes(settings_of(projection, 64, 60));
        for (std::uint32_t i = 0; i < 64; ++i) {
            const auto corners = planes.triangles.corners(i);
            const Vec3d a{corners[0]};
            const Vec3d normal =
                glm::normalize(glm::cross(Vec3d{corners[1]} - a, Vec3d{corners[2]} - a));
            // Corners some 0.1 m apart round to 2^-19 m at most: 1e-4 rad.
            EXPECT_NEAR(std::acos(std::abs(normal.z)), glm::radians(60.0), 1e-4) << i;
        }
    }
}

TEST(MeasuredPlanes, StayBetweenNearAndFar)
{
    for (const Projection projection : both_projections) {
        for (const double tilt_deg : {0.0, 45.0, 80.0}) {
            const MeasuredPlanes planes =
                make_measured_planes(settings_of(projection, 500, tilt_deg, 10));
            for (const Vec3f& vertex : planes.triangles.vertices) {
                const double light_distance_m = planes.frustum.light_distance_m(Vec3d{vertex});
                EXPECT_TRUE(light_distance_m > 4 && light_distance_m < 50)
                    << light_distance_m << " tilt " << tilt_deg;
            }
        }
    }
}

TEST(MeasuredPlanes, HaveATexelEach)
{
    const MeasuredPlanes planes = make_measured_planes(settings_of(Projection::perspective, 1000));
    std::set<std::pair<int, int>> texels;
    for (std::size_t i = 0; i < 1000; ++i) {
        const auto [x, y] = planes.texel(i);
        EXPECT_TRUE(x >= 0 && x < planes.resolution_texels) << x;
        EXPECT_TRUE(y >= 0 && y < planes.resolution_texels) << y;
        texels.emplace(x, y);
    }
    EXPECT_EQ(texels.size(), 1000U);
}

TEST(MeasuredPlanes, RefuseWhatCannotBeMeasured)
{
    const auto refused = [](auto change) {
        MeasuredPlaneSettings settings = settings_of(Projection::perspective, 64);
        change(settings);
        EXPECT_THROW((void)make_measured_planes(settings), InputError);
    };
    refused([](auto& s) { s.count = 0; });
    refused([](auto& s) { s.count = (1 << 22) + 1; });
    refused([](auto& s) { s.tilt_rad = -0.1; });
    refused([](auto& s) { s.tilt_rad = 1.5; });
    refused([](auto& s) { s.tilt_rad = std::nan(""); });
    refused([](auto& s) { s.offset_m = INFINITY; });
    refused([](auto& s) { s.offset_m = 1e12; });
}

TEST(RasterPlane, IsThePlaneThroughItsCorners)
{
    // On the corners of a map of 8 texels: window (0, 0), (8, 0), (0, 8) at depths 0, ½, 1.
    const RasterPlane plane{{Vec4f{-1, -1, -1, 1}, Vec4f{2, -2, 0, 2}, Vec4f{-1, 1, 1, 1}},
                            8,
                            ClipRange::minus_one_to_one};
    EXPECT_TRUE(plane.is_whole());
    EXPECT_EQ(plane.depth({0, 0}), 0);
    EXPECT_EQ(plane.depth({8, 0}), 0.5);
    EXPECT_EQ(plane.depth({0, 8}), 1);
    EXPECT_EQ(plane.depth({2, 2}), 0.375);
    EXPECT_EQ(plane.inside_px({1, 2}), 1);
    EXPECT_LT(plane.inside_px({5, 5}), 0);
    EXPECT_GT(plane.driver_bound({2, 2}, 8), 0);
}

TEST(RasterPlane, IsNotWholeBehindNearOrWithoutArea)
{
    const auto is_whole = [](float z, ClipRange range) {
        return RasterPlane{
            {Vec4f{-1, -1, z, 1}, Vec4f{1, -1, z, 1}, Vec4f{-1, 1, 0.5F, 1}}, 8, range}
            .is_whole();
    };
    EXPECT_TRUE(is_whole(-0.5F, ClipRange::minus_one_to_one));
    EXPECT_FALSE(is_whole(-0.5F, ClipRange::zero_to_one));
    EXPECT_FALSE(is_whole(1.5F, ClipRange::minus_one_to_one));
    EXPECT_FALSE((RasterPlane{
        {Vec4f{-1, -1, 0, 1}, Vec4f{0, 0, 0, 1}, Vec4f{1, 1, 0, 1}}, 8, ClipRange::minus_one_to_one}
                      .is_whole()));
}

} // namespace
} // namespace gnomon::scene
