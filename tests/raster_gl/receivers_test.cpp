#include "gl_case.hpp"

#include "raster_gl/receivers.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <set>

namespace gnomon::raster_gl {

namespace {

using tests::GlCase;

const std::vector<scene::Override> small_image{{"image.width", "320"}, {"image.height", "180"}};

std::set<std::string> visible_objects(const GlCase& c)
{
    std::set<std::string> names;
    for (const std::uint32_t t : read_triangles(*tests::shared_context(), *c.receivers)) {
        if (t != scene::no_triangle) {
            names.insert(c.file.scene.objects.at(c.file.scene.object_of(t)).name);
        }
    }
    return names;
}

TEST(Receivers, ShowEveryObjectInFront)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane", small_image};
    c.draw_receivers();
    EXPECT_EQ(visible_objects(c).size(), c.file.scene.objects.size());
}

TEST(Receivers, LeaveOutObjectsThatDoNotReceive)
{
    GNOMON_REQUIRE_GL();
    GlCase whole{"sphere-plane", small_image};
    const std::string first = whole.file.scene.objects.front().name;
    GlCase c{"sphere-plane",
             {{"scene.no_receive", "[\"" + first + "\"]"},
              {"image.width", "320"},
              {"image.height", "180"}}};
    c.draw_receivers();
    const auto names = visible_objects(c);
    EXPECT_FALSE(names.contains(first));
    EXPECT_EQ(names.size(), c.file.scene.objects.size() - 1);
    // Objects after the gap keep their triangle indices.
    whole.draw_receivers();
    const auto before = read_triangles(*tests::shared_context(), *whole.receivers);
    const auto after = read_triangles(*tests::shared_context(), *c.receivers);
    std::size_t renamed = 0;
    for (std::size_t i = 0; i < before.pixel_count(); ++i) {
        const bool is_of_another =
            before[i] != scene::no_triangle &&
            whole.file.scene.objects.at(whole.file.scene.object_of(before[i])).name != first;
        renamed += is_of_another && after[i] != before[i] ? 1U : 0U;
    }
    EXPECT_EQ(renamed, 0U);
}

TEST(Receivers, InterpolateTheWorldPositionOfTheirTriangle)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane", small_image};
    c.draw_receivers();
    const auto triangles = read_triangles(*tests::shared_context(), *c.receivers);
    const auto positions = read_world_positions(*tests::shared_context(), *c.receivers);
    // The scene is about 20 m wide and drawn in float32: 20 · 2^-24 · a few roundings.
    constexpr double tolerance_m = 1e-4;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        if (triangles[i] == scene::no_triangle) {
            EXPECT_EQ(positions[i].w, 0.0F);
            continue;
        }
        const auto corners = c.file.scene.corners(triangles[i]);
        const scene::Vec3d a{corners[0]};
        const scene::Vec3d normal =
            glm::normalize(glm::cross(scene::Vec3d{corners[1]} - a, scene::Vec3d{corners[2]} - a));
        const scene::Vec3d p{positions[i]};
        ASSERT_LT(std::abs(glm::dot(normal, p - a)), tolerance_m) << "pixel " << i;
    }
}

TEST(Receivers, AreTheSameBytesEachTime)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"yard", small_image};
    c.draw_receivers();
    const auto first = read_light_clip(*tests::shared_context(), *c.receivers);
    c.draw_receivers();
    const auto second = read_light_clip(*tests::shared_context(), *c.receivers);
    for (std::size_t i = 0; i < first.pixel_count(); ++i) {
        ASSERT_EQ(first[i], second[i]) << "pixel " << i;
    }
}

TEST(ClipPositions, EqualTheMatrixProductWithinFourRoundings)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane", small_image};
    const auto captured = capture_clip_positions(*tests::shared_context(), c.gpu,
                                                 c.view.first_map().light_clip_from_world);
    ASSERT_EQ(captured.size(), c.file.scene.vertices.size());
    const scene::Mat4d m{c.view.first_map().light_clip_from_world};
    for (std::size_t i = 0; i < captured.size(); ++i) {
        const scene::Vec4d p{scene::Vec3d{c.file.scene.vertices[i]}, 1};
        const scene::Vec4d exact = m * p;
        for (int row = 0; row < 4; ++row) {
            double sum = 0;
            for (int column = 0; column < 4; ++column) {
                sum += std::abs(m[column][row] * p[column]);
            }
            // γ4·S: four products and three sums, each rounded once (or fused).
            ASSERT_LE(std::abs(double{captured[i][row]} - exact[row]), 4.1 * 0x1p-24 * sum)
                << "vertex " << i << " row " << row;
        }
    }
}

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
