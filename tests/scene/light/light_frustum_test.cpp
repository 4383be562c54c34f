// The light's camera, and what maps store.

#include "scene/error.hpp"
#include "scene/light/fit_frustum.hpp"
#include "scene/light/frustum.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::scene {
namespace {

using Corner = std::array<std::uint32_t, 3>;

/// A tetrahedron-like soup whose vertices span [−2, 2] × [0, 1] × [−3, 3].
TriangleScene soup()
{
    SceneBuilder builder;
    const std::vector<Vec3d> vertices{{-2, 0, -3}, {2, 0, -3}, {2, 0, 3}, {-2, 0, 3}, {0, 1, 0}};
    builder.add("soup", vertices,
                std::vector<Corner>{{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}});
    return builder.take();
}

LightSettings directional(const Vec3d& direction)
{
    LightSettings light;
    light.direction = direction;
    return light;
}

LightSettings spot_above()
{
    LightSettings light;
    light.type = LightType::spot;
    light.cone_deg = 90;
    light.position = Vec3d{0.5, 5, 0};
    light.target = Vec3d{0, 0, 0};
    return light;
}

LightFrustum fitted(const FrustumSettings& settings, const LightSettings& light,
                    const CameraSettings& camera = {.eye = {0, 6, 9}, .target = {0, 0, 0}})
{
    return fit_light_frustum(settings, light, make_light(light), soup(), make_camera(camera),
                             {640, 360});
}

Vec3d ndc_of(const LightFrustum& frustum, const Vec3d& p)
{
    const Vec4d clip = frustum.light_clip_from_world_exact * Vec4d{p, 1};
    return Vec3d{clip} / clip.w;
}

TEST(SceneFit, OfASunIsTheSmallestLightViewBox)
{
    const LightFrustum f = fitted({}, directional({0.3, -1, -0.2}));
    Vec3d lower{INFINITY};
    Vec3d upper{-INFINITY};
    for (const Vec3f& v : soup().vertices) {
        lower = glm::min(lower, ndc_of(f, Vec3d{v}));
        upper = glm::max(upper, ndc_of(f, Vec3d{v}));
    }
    for (int axis = 0; axis < 2; ++axis) { // a few double roundings
        EXPECT_NEAR(lower[axis], -1, 1e-12);
        EXPECT_NEAR(upper[axis], 1, 1e-12);
    }
    // Padded by 1e-4 of the range on both sides: ±1/(1 + 2e-4).
    EXPECT_NEAR(lower.z, -1 / 1.0002, 1e-12);
    EXPECT_NEAR(upper.z, 1 / 1.0002, 1e-12);
}

TEST(SceneFit, OfASpotHasTheConesFov)
{
    const LightFrustum f = fitted({}, spot_above());
    EXPECT_EQ(f.projection, Projection::perspective);
    EXPECT_NEAR(f.top, 1, 1e-15); // tan 45°
    EXPECT_GE(f.near_m, 1e-3 * f.far_m);
    for (const Vec3f& v : soup().vertices) {
        EXPECT_LT(f.light_distance_m(Vec3d{v}), f.far_m);
        EXPECT_GT(f.light_distance_m(Vec3d{v}), f.near_m);
    }
}

TEST(SceneFit, PutsASpotThatTouchesTheSceneAThousandthOfFarBeforeItsNearPlane)
{
    LightSettings light = spot_above();
    light.position = Vec3d{0, 1, 0}; // the soup's top
    light.target = Vec3d{0, 0, 0};
    const LightFrustum f = fitted({}, light);
    // Not beyond the padding, despite float32's error at far = 1000 near: near would follow.
    EXPECT_DOUBLE_EQ(f.far_m, 1 + 1e-4);
    EXPECT_DOUBLE_EQ(f.near_m, 1e-3 * f.far_m);
}

TEST(SceneFit, GivesAFlatSceneABox)
{
    SceneBuilder builder;
    const std::vector<Vec3d> vertices{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    builder.add("flat", vertices, std::vector<Corner>{{0, 2, 1}});
    const LightSettings light = directional({0, -1, 0});
    const LightFrustum f = fit_light_frustum({}, light, make_light(light), builder.take(),
                                             make_camera({}), {640, 360});
    EXPECT_LT(f.near_m, f.far_m);
}

TEST(Frustum, MapsNearAndFarToTheClipRange)
{
    for (const bool reversed : {false, true}) {
        for (const LightSettings& light : {directional({0, -1, 0.1}), spot_above()}) {
            const LightFrustum f =
                fitted({.near_m = 0.5, .far_m = 8.0, .reversed = reversed}, light);
            const double at_near = ndc_of(f, f.origin + f.near_m * f.forward).z;
            const double at_far = ndc_of(f, f.origin + f.far_m * f.forward).z;
            // Cancellation of products around 10: a few times 10·2^-53 over w >= 0.5.
            EXPECT_NEAR(at_near, reversed ? 1 : -1, 1e-14);
            EXPECT_NEAR(at_far, reversed ? 0 : 1, 1e-14);
        }
    }
}

TEST(Frustum, IsRightHandedAndSeesUpAsUp)
{
    const LightFrustum f = fitted({}, directional({1, -1, 0}));
    EXPECT_NEAR(glm::dot(glm::cross(f.right, f.up), -f.forward), 1, 1e-15);
    EXPECT_GT(f.up.y, 0);
}

TEST(Frustum, RollTurnsTheAxesAboutTheLight)
{
    const LightFrustum plain = fitted({}, directional({1, -1, 0.5}));
    const LightFrustum rolled = fitted({.roll_deg = 90}, directional({1, -1, 0.5}));
    EXPECT_NEAR(glm::dot(rolled.right, plain.up), 1, 1e-15);
    EXPECT_NEAR(glm::dot(rolled.up, plain.right), -1, 1e-15);
    EXPECT_EQ(rolled.forward, plain.forward);
}

TEST(FixedFit, StandsAtItsPositionWithItsExtent)
{
    LightSettings light = directional({0, -1, 0});
    light.position = Vec3d{1, 10, 2};
    const LightFrustum f =
        fitted({.fit = Fit::fixed, .half_extent_m = 20, .near_m = 0.01, .far_m = 100.0}, light);
    EXPECT_EQ(f.origin, (Vec3d{1, 10, 2}));
    EXPECT_EQ(f.right_side, 20);
    EXPECT_EQ(f.light_distance_m({1, 0, 2}), 10);
    EXPECT_NEAR(ndc_of(f, {1, 0, 2}).x, 0, 1e-15);
    EXPECT_NEAR(std::abs(ndc_of(f, {21, 0, 2}).x), 1, 1e-15);
}

TEST(FixedFit, OfASpotTakesItsFov)
{
    const LightFrustum f = fitted({.fit = Fit::fixed, .fov_deg = 60.0}, spot_above());
    EXPECT_DOUBLE_EQ(f.top, std::tan(M_PI / 6));
}

TEST(CameraFit, HoldsWhatTheCameraSeesAndNoMore)
{
    const CameraSettings close{
        .eye = {0.2, 0.9, 0.9}, .target = {0, 0.3, 0}, .vertical_fov_deg = 20};
    for (const LightSettings& light : {directional({0.3, -1, -0.2}), spot_above()}) {
        const LightFrustum whole = fitted({}, light, close);
        const LightFrustum narrow = fitted({.fit = Fit::camera}, light, close);
        EXPECT_LT(narrow.right_side - narrow.left, 0.6 * (whole.right_side - whole.left));
        // The top of the soup, in the middle of the view, is inside.
        const Vec3d ndc = ndc_of(narrow, {0, 0.5, 0});
        EXPECT_LE(std::abs(ndc.x), 1);
        EXPECT_LE(std::abs(ndc.y), 1);
        EXPECT_GE(narrow.near_m, whole.near_m) << "what is beside the narrow map does not count";
    }
}

TEST(CameraFit, FallsBackToTheSceneWhereTheCameraSeesNothing)
{
    const CameraSettings away{.eye = {0, 6, 9}, .target = {0, 12, 18}};
    const LightFrustum whole = fitted({}, directional({0.3, -1, -0.2}), away);
    const LightFrustum narrow = fitted({.fit = Fit::camera}, directional({0.3, -1, -0.2}), away);
    EXPECT_EQ(narrow.light_clip_from_world, whole.light_clip_from_world);
}

TEST(TexelWidth, IsTheLargerSideAndGrowsWithASpotsDistance)
{
    const LightFrustum sunlit = fitted({}, directional({0, -1, 0}));
    EXPECT_DOUBLE_EQ(sunlit.texel_width_m(123, 600), 6.0 / 600); // z spans 6 m, x 4 m
    const LightFrustum spot = fitted({}, spot_above());
    EXPECT_DOUBLE_EQ(spot.texel_width_m(3, 100), 2 * 3 * std::tan(M_PI / 4) / 100);
}

TEST(Frustum, RefusesImpossibleDepthRanges)
{
    EXPECT_THROW((void)fitted({.near_m = 5.0, .far_m = 5.0}, directional({0, -1, 0})), InputError);
    EXPECT_THROW((void)fitted({.near_m = 1e6}, directional({0, -1, 0})), InputError);
    EXPECT_THROW((void)fitted({.near_m = 0.0}, spot_above()), InputError);
    EXPECT_THROW((void)fitted({.near_m = -1.0}, spot_above()), InputError);
    EXPECT_NO_THROW((void)fitted({.near_m = -1.0}, directional({0, -1, 0})));
}

TEST(MapContents, AreKnownByTheirNames)
{
    for (const MapContentTraits& traits : map_contents()) {
        EXPECT_EQ(map_content_from_name(map_content_name(traits.content)), traits.content);
    }
    EXPECT_EQ(map_content_from_name("depths"), std::nullopt);
}

TEST(MapContents, StoreWhatAShaderWritesEvenlyUpToFar)
{
    LightFrustum spot;
    spot.projection = Projection::perspective;
    spot.near_m = 2;
    spot.far_m = 10;
    spot.reversed = true;
    for (const MapContentTraits& traits : map_contents()) {
        spot.content = traits.content;
        const DepthRange stored = spot.stored_range();
        EXPECT_EQ(stored.projection == Projection::perspective, traits.is_gl_depth());
        EXPECT_EQ(stored.reversed, traits.is_gl_depth());
        EXPECT_EQ(stored.near_m, traits.from_near ? 2 : 0);
        EXPECT_EQ(stored.far_m, 10);
    }
}

TEST(MapContents, ReachFartherThanTheirLightDistanceAlongRaysAlone)
{
    LightFrustum spot;
    spot.right_side = 2;
    spot.top = 2;
    for (const MapContentTraits& traits : map_contents()) {
        spot.content = traits.content;
        // √(2² + 2² + 1²)
        EXPECT_EQ(spot.largest_per_light_distance(), traits.measure == Measure::ray ? 3 : 1);
    }
}

} // namespace

} // namespace gnomon::scene
