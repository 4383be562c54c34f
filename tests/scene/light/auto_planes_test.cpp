#include "scene/light/frustum.hpp"

#include "scene/light/fit_frustum.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::scene {
namespace {

/// A horizontal square.
void add_square(SceneBuilder& builder, const char* name, const Vec3d& centre, double half_m)
{
    const std::vector<Vec3d> corners{
        centre + Vec3d{-half_m, 0, -half_m}, centre + Vec3d{half_m, 0, -half_m},
        centre + Vec3d{half_m, 0, half_m}, centre + Vec3d{-half_m, 0, half_m}};
    builder.add(name, corners, std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 3, 2}});
}

/// A triangle that rises from the ground under the lights to a tip.
void add_fin(SceneBuilder& builder, const char* name, const Vec3d& tip)
{
    const std::vector<Vec3d> corners{{0, 0, -0.5}, {0, 0, 0.5}, tip};
    builder.add(name, corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
}

/// A floor 10 m under the lights below, and a table on it at 4 m.
SceneBuilder floor_and_table()
{
    SceneBuilder builder;
    add_square(builder, "floor", {0, 0, 0}, 1);
    add_square(builder, "table", {0, 4, 0}, 0.5);
    return builder;
}

/// Ten metres up, down the axis; the map's sides are |x|, |z| <= ζ.
LightSettings spot()
{
    LightSettings light;
    light.type = LightType::spot;
    light.cone_deg = 90;
    light.position = Vec3d{0, 10, 0};
    light.target = Vec3d{0, 0, 0};
    return light;
}

LightSettings directional()
{
    LightSettings light;
    light.direction = Vec3d{0, -1, 0};
    light.position = Vec3d{0, 10, 0};
    return light;
}

LightFrustum map_of(const TriangleScene& scene, const LightSettings& light,
                    const FrustumSettings& settings = {}, const CameraSettings& camera = {})
{
    return fit_light_frustum(settings, light, make_light(light), scene, make_camera(camera),
                             {640, 360});
}

void expect_planes_around(const LightFrustum& frustum, double nearest_m, double farthest_m,
                          double tolerance_m = 1e-12) // a few double roundings of 10 m
{
    const double padding_m = 1e-4 * (farthest_m - nearest_m);
    EXPECT_NEAR(frustum.near_m, nearest_m - padding_m, tolerance_m);
    EXPECT_NEAR(frustum.far_m, farthest_m + padding_m, tolerance_m);
}

// Geometry counts up to 8·2^-24 of a side's absolute terms beyond the side; these are at most 40
// here. Where W ± X changes by 1 along these triangles, ζ changes by less than 1 m.
constexpr double side_tolerance_m = 8 * 0x1p-24 * 40;

TEST(AutoPlanes, LeaveOutWhatIsBesideTheMap)
{
    SceneBuilder builder = floor_and_table();
    add_square(builder, "shelf", {6, 9, 0}, 1);     // ζ = 1, beside a cone of 1 m
    add_square(builder, "cellar", {80, -30, 0}, 1); // ζ = 40
    const TriangleScene scene = builder.take();
    expect_planes_around(map_of(scene, spot()), 6, 10);
    expect_planes_around(map_of(scene, directional(), {.fit = Fit::fixed, .half_extent_m = 2}), 6,
                         10);
}

TEST(AutoPlanes, CountATriangleAsFarAsTheSideThatItCrosses)
{
    SceneBuilder builder;
    add_fin(builder, "fin", {20, 9, 0}); // x = 20t, ζ = 10 − 9t: the cone's side x = ζ at t = 10/29
    const TriangleScene scene = builder.take();
    expect_planes_around(map_of(scene, spot()), 200.0 / 29, 10, side_tolerance_m);
    // The square's side x = 2 at t = 1/10.
    expect_planes_around(map_of(scene, directional(), {.fit = Fit::fixed, .half_extent_m = 2}), 9.1,
                         10, side_tolerance_m);
}

TEST(AutoPlanes, CountATriangleThatReachesBehindTheSpot)
{
    SceneBuilder builder;
    add_fin(builder, "fin", {8, 20, 0}); // x = 8t, ζ = 10 − 20t: x = ζ at t = 10/28
    expect_planes_around(map_of(builder.take(), spot()), 20.0 / 7, 10, side_tolerance_m);
}

TEST(AutoPlanes, CountATriangleWhoseCornersAreAllBesideTheMap)
{
    SceneBuilder builder = floor_and_table();
    add_square(builder, "roof", {0, 8, 0}, 50);
    expect_planes_around(map_of(builder.take(), spot()), 2, 10, side_tolerance_m);
}

TEST(AutoPlanes, CountEveryObjectWhateverItsRole)
{
    TriangleScene scene = floor_and_table().take();
    set_roles(scene, std::vector<std::string>{"table"}, std::vector<std::string>{"table"});
    expect_planes_around(map_of(scene, spot()), 6, 10);
}

TEST(AutoPlanes, OfACameraFitReachFromAnyCasterWithinTheSidesToTheFarthestSeen)
{
    SceneBuilder builder;
    add_square(builder, "floor", {0, 0, 0}, 20);
    add_square(builder, "lamp", {0, 7, 0}, 0.1);   // above the camera, over what it sees
    add_square(builder, "crane", {15, 9, 0}, 0.1); // over what it does not
    const CameraSettings down{.eye = {0, 6, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}};
    const TriangleScene scene = builder.take();
    const LightFrustum frustum = map_of(scene, directional(), {.fit = Fit::camera}, down);
    EXPECT_LT(frustum.right_side, 5);
    EXPECT_NEAR(frustum.near_m, 3 - 7e-4, 1e-12);
    EXPECT_GE(frustum.far_m, 10);
    EXPECT_LE(frustum.far_m, 10 + 1e-3);
}

TEST(AutoPlanes, EncloseTheWholeSceneWhereTheMapHoldsNothingOfIt)
{
    const TriangleScene scene = floor_and_table().take();
    LightSettings away = directional();
    away.position = Vec3d{100, 10, 0};
    expect_planes_around(map_of(scene, away, {.fit = Fit::fixed, .half_extent_m = 2}), 6, 10);
    LightSettings beside = spot();
    beside.position = Vec3d{100, 10, 0};
    beside.target = Vec3d{100, 0, 0};
    expect_planes_around(map_of(scene, beside), 6, 10);
}

TEST(AutoPlanes, EncloseTheWholeSceneWhereAGivenPlaneLeavesNothingOfTheMap)
{
    SceneBuilder builder = floor_and_table();
    add_square(builder, "shelf", {6, 9, 0}, 1);
    const LightFrustum frustum = map_of(builder.take(), spot(), {.far_m = 5.0});
    EXPECT_NEAR(frustum.near_m, 1 - 9e-4, 1e-12);
    EXPECT_EQ(frustum.far_m, 5);
}

TEST(AutoPlanes, HoldEveryVertexByTheFloat32MatrixFarFromTheOrigin)
{
    const Vec3d far_away{20000, 30, -20000};
    for (const bool is_spot : {true, false}) {
        SceneBuilder builder;
        add_square(builder, "floor", far_away, 1);
        add_square(builder, "table", far_away + Vec3d{0, 1, 0}, 0.5);
        const TriangleScene scene = builder.take();
        LightSettings light = is_spot ? spot() : directional();
        light.direction = is_spot ? std::nullopt : std::optional{Vec3d{1, -2, 1}};
        light.position = far_away + Vec3d{-5, 10, -5};
        light.target = is_spot ? std::optional{far_away} : std::nullopt;
        const LightFrustum frustum = map_of(scene, light);
        for (const Vec3f& vertex : scene.vertices) {
            const Vec4f clip = frustum.light_clip_from_world * Vec4f{vertex, 1}; // as GL does
            EXPECT_LE(std::abs(clip.z), clip.w) << "spot: " << is_spot;
        }
    }
}

} // namespace
} // namespace gnomon::scene
