#include "gl_case.hpp"

#include "scene/geometry/vertex_normals.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>

/// Receivers that are drawn with the normals of their vertices.
namespace gnomon::raster_gl {
namespace {

using tests::GlCase;
using tests::shared_context;

const std::vector<scene::Override> small_view{{"image.width", "320"}, {"image.height", "180"}};

scene::TriangleScene with_normals(scene::TriangleScene scene)
{
    scene::complete_vertex_normals(scene);
    return scene;
}

TEST(ReceiversWithNormals, ShowWhatTheyShowWithout)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin : {"sphere-plane", "yard"}) {
        GlCase c{builtin, small_view};
        c.draw_receivers();
        const GpuScene gpu{*shared_context(), with_normals(c.file.scene)};
        ReceiverPass pass{*shared_context()};
        const ReceiverBuffer& with = pass.render(gpu, c.view, c.file.scene.bounds());
        EXPECT_TRUE(c.receivers->vertex_normal.empty());
        const auto triangles = read_triangles(*shared_context(), *c.receivers);
        const auto positions = read_world_positions(*shared_context(), *c.receivers);
        const auto clips = read_light_clip(*shared_context(), *c.receivers);
        const auto same_triangles = read_triangles(*shared_context(), with);
        const auto same_positions = read_world_positions(*shared_context(), with);
        const auto same_clips = read_light_clip(*shared_context(), with);
        std::size_t different = 0;
        for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
            different += triangles[i] != same_triangles[i] || positions[i] != same_positions[i] ||
                                 clips[i] != same_clips[i]
                             ? 1U
                             : 0U;
        }
        EXPECT_EQ(different, 0U) << builtin;
    }
}

// Normals differ by up to some tenths across a triangle that covers a few pixels or more; weights
// of corners are interpolated in float32, at most as exactly as the driver snaps corners: 1/256 px.
TEST(ReceiversWithNormals, InterpolateThem)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane", small_view};
    const scene::TriangleScene scene = with_normals(c.file.scene);
    const GpuScene gpu{*shared_context(), scene};
    ReceiverPass pass{*shared_context()};
    const ReceiverBuffer& buffer = pass.render(gpu, c.view, scene.bounds());
    const auto triangles = read_triangles(*shared_context(), buffer);
    const auto positions = read_world_positions(*shared_context(), buffer);
    const auto normals = read_vertex_normals(*shared_context(), buffer);
    std::size_t curved = 0;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        const scene::Vec3d normal{normals[i]};
        if (triangles[i] == scene::no_triangle) {
            ASSERT_EQ(normal, scene::Vec3d(0, 0, 0));
            continue;
        }
        const scene::Vec3d expected =
            scene::vertex_normal_at(scene, triangles[i], scene::Vec3d{positions[i]});
        ASSERT_LE(glm::length(glm::normalize(normal) - expected), 2e-3) << "pixel " << i;
        const auto corners = scene.corners(triangles[i]);
        const scene::Vec3d a{corners[0]};
        const scene::Vec3d geometric =
            glm::normalize(glm::cross(scene::Vec3d{corners[1]} - a, scene::Vec3d{corners[2]} - a));
        curved += glm::dot(geometric, expected) < 0.9999 ? 1U : 0U;
    }
    EXPECT_GT(curved, 300U);
}

} // namespace
} // namespace gnomon::raster_gl
