#include "gl_case.hpp"

#include "raster_gl/clip_positions.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <cmath>
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
    // What is drawn after the gap keeps its triangles' numbers.
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

} // namespace
} // namespace gnomon::raster_gl
