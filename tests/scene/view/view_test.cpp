#include "scene/error.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

} // namespace
} // namespace gnomon::scene
