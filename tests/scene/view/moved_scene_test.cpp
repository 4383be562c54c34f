#include "scene/view/moved_scene.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace gnomon::scene {
namespace {

/// A square of a metre whose lowest corner is there.
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

} // namespace
} // namespace gnomon::scene
