#include "scene/error.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/moved_scene.hpp"
#include "scene/view/nearby_cameras.hpp"
#include "scene/view/view.hpp"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gnomon::scene {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TriangleScene triangle_and_ground()
{
    SceneBuilder builder;
    const std::vector<Vec3d> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    builder.add("triangle", vertices, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    TriangleScene scene = builder.take();
    add_ground(scene);
    return scene;
}

TEST(ResolveView, FramesTheSceneWithoutItsGround)
{
    const View view = resolve_view({}, triangle_and_ground(), {});
    // The triangle is about a metre in size; its ground reaches 4 m.
    EXPECT_LT(glm::length(view.camera.eye), 4.0);
    EXPECT_EQ(view.light.direction, (Vec3d{-0x1.99999ap-2, -1, -0x1.333334p-2}));
}

TEST(ResolveView, PrefersTheJobsCameraToTheFiles)
{
    SceneDefaults defaults;
    defaults.camera = CameraSettings{.eye = {1, 2, 3}};
    defaults.light = LightSettings{};
    defaults.light->direction = Vec3d{0, -2, 0};
    Job job;
    EXPECT_EQ(resolve_view(job, triangle_and_ground(), defaults).camera.eye, (Vec3d{1, 2, 3}));
    EXPECT_EQ(resolve_view(job, triangle_and_ground(), defaults).light.direction,
              (Vec3d{0, -2, 0}));
    job.camera = CameraSettings{.eye = {4, 5, 6}};
    EXPECT_EQ(resolve_view(job, triangle_and_ground(), defaults).camera.eye, (Vec3d{4, 5, 6}));
}

TEST(ResolveView, ConvertsABiasInMetresByTheDepthRange)
{
    Job job;
    job.bias.constant_m = 0.25;
    job.shadow_map.frustum.near_m = -10;
    job.shadow_map.frustum.far_m = 10;
    EXPECT_EQ(resolve_view(job, triangle_and_ground(), {}).bias.constant, 0.0125F);
}

TEST(ResolveView, RefusesABiasInMetresForASpot)
{
    Job job;
    job.bias.constant_m = 0.25;
    LightSettings spot;
    spot.type = LightType::spot;
    spot.position = Vec3d{0, 3, 0};
    spot.target = Vec3d{0, 0, 0};
    job.light = spot;
    EXPECT_THAT([&] { (void)resolve_view(job, triangle_and_ground(), {}); },
                ThrowsMessage<InputError>(HasSubstr("bias.constant_m")));
}

TEST(ResolveView, RefusesSubnormalBiases)
{
    for (double BiasSettings::*key :
         {&BiasSettings::constant, &BiasSettings::slope, &BiasSettings::normal_texels}) {
        Job job;
        job.bias.*key = 1e-39;
        EXPECT_THROW((void)resolve_view(job, triangle_and_ground(), {}), InputError);
        job.bias.*key = 1e-60; // zero in float32, but the user meant something else
        EXPECT_THROW((void)resolve_view(job, triangle_and_ground(), {}), InputError);
        job.bias.*key = 1.2e-38;
        EXPECT_NO_THROW((void)resolve_view(job, triangle_and_ground(), {}));
    }
}

/// A square of one metre with its lowest corner at `corner`.
SceneFile square_at(const Vec3f& corner)
{
    SceneFile file;
    file.scene.vertices = {corner, corner + Vec3f{1, 0, 0}, corner + Vec3f{0, 0, 1}};
    file.scene.triangles = {{0, 1, 2}};
    file.scene.objects = {{"square", 0, 1, true, true}};
    return file;
}

Job job_at(const Vec3d& target)
{
    Job job;
    job.camera = CameraSettings{};
    job.camera->eye = target + Vec3d{0, 2, 4};
    job.camera->target = target;
    job.light = LightSettings{};
    job.light->type = LightType::spot;
    job.light->position = target + Vec3d{1, 8, 1};
    job.light->target = target;
    return job;
}

TEST(MovedScene, IsNearTheOriginAndOtherwiseTheSame)
{
    const Vec3f corner{20000.25F, 0, -70000.5F};
    const SceneFile file = square_at(corner);
    const Job job = job_at(Vec3d{corner});
    const auto moved = move_origin_near(job, file);
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->origin.y, 0) << "it is near along y";
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(Vec3d{moved->file.scene.vertices[i]} + moved->origin,
                  Vec3d{file.scene.vertices[i]});
        EXPECT_LT(glm::length(moved->file.scene.vertices[i]), 2);
    }
    EXPECT_EQ(moved->job.camera->eye + moved->origin, job.camera->eye);
    EXPECT_EQ(*moved->job.light->position + moved->origin, *job.light->position);
    const Camera before = make_camera(*job.camera);
    EXPECT_EQ(make_camera(*moved->job.camera).forward, before.forward) << "bit by bit";
}

TEST(MovedScene, IsNoneWhereTheOriginIsNear)
{
    EXPECT_FALSE(move_origin_near(job_at({0, 0, 0}), square_at({-0.5F, 0, 0.25F})));
}

double degrees_between(const Vec3d& a, const Vec3d& b)
{
    const double cosine = glm::dot(glm::normalize(a), glm::normalize(b));
    return std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi;
}

TEST(NearbyCamera, IsThatOfTheFormula)
{
    CameraSettings own;
    own.eye = {0, 0, 4};
    own.target = {0, 0, 0};
    // k = 1: a = 1/2, b = 1/3, c = 1/5; cos α = 3/4, to the side of 120°.
    const CameraSettings nearby = nearby_camera(own, 1);
    const double length = 4 * std::exp2(0.2 - 0.5);
    const double sine = std::sqrt(1 - 0.75 * 0.75);
    // 1e-12: a few roundings of numbers below 4.
    EXPECT_NEAR(nearby.eye.x, length * sine * -0.5, 1e-12);
    EXPECT_NEAR(nearby.eye.y, length * sine * std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(nearby.eye.z, length * 0.75, 1e-12);
    EXPECT_EQ(nearby.target, own.target);
    EXPECT_EQ(nearby.up, own.up);
}

TEST(NearbyCamera, StaysInItsCapAndDistances)
{
    CameraSettings own;
    own.projection = Projection::orthographic;
    const double own_m = glm::length(own.eye - own.target);
    for (std::uint32_t k = 1; k <= 200; ++k) {
        const CameraSettings nearby = nearby_camera(own, k);
        const double distance_m = glm::length(nearby.eye - nearby.target);
        EXPECT_LE(degrees_between(nearby.eye - nearby.target, own.eye - own.target), 60 + 1e-9)
            << k;
        EXPECT_GE(distance_m, own_m / std::numbers::sqrt2 * (1 - 1e-12)) << k;
        EXPECT_LT(distance_m, own_m * std::numbers::sqrt2) << k;
        EXPECT_NEAR(nearby.orthographic_height_m / own.orthographic_height_m, distance_m / own_m,
                    1e-12)
            << k;
    }
}

TEST(NearbyLight, TurnsByAtMostThirtyDegrees)
{
    LightSettings directional;
    directional.direction = Vec3d{0, -2, 0};
    LightSettings spot;
    spot.type = LightType::spot;
    spot.position = Vec3d{1, 5, 2};
    spot.target = Vec3d{0, 1, 0};
    for (std::uint32_t k = 1; k <= 200; ++k) {
        EXPECT_LE(degrees_between(*nearby_light(directional, k).direction, *directional.direction),
                  30 + 1e-6)
            << k;
        const LightSettings turned = nearby_light(spot, k);
        EXPECT_EQ(turned.target, spot.target);
        EXPECT_LE(degrees_between(*turned.target - *turned.position, *spot.target - *spot.position),
                  30 + 1e-6)
            << k;
        EXPECT_NEAR(glm::length(*turned.target - *turned.position),
                    glm::length(*spot.target - *spot.position), 1e-12)
            << k;
    }
}

TEST(NearbyViews, RefuseWhatIsNoCameraOrLight)
{
    CameraSettings nowhere;
    nowhere.target = nowhere.eye;
    EXPECT_THROW((void)nearby_camera(nowhere, 1), InputError);
    EXPECT_THROW((void)nearby_light({}, 1), InputError);
}

TEST(NearbyLight, IsNoneOfAPointLight)
{
    LightSettings point;
    point.type = LightType::point;
    point.position = Vec3d{1, 5, 2};
    EXPECT_THROW((void)nearby_light(point, 1), std::invalid_argument);
}

} // namespace

} // namespace gnomon::scene
