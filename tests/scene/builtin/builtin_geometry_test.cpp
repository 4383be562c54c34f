#include "mesh_checks.hpp"

#include "lane.hpp"
#include "scene/builtin/objects.hpp"
#include "scene/builtin/scenes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace gnomon::scene {
namespace {

using test::check_edges;
using test::coplanar_overlaps;
using test::triangle_name;

[[nodiscard]] TriangleScene scene_of(const Mesh& mesh)
{
    SceneBuilder builder;
    builder.add("mesh", mesh.vertices, mesh.triangles);
    return builder.take();
}

[[nodiscard]] TriangleScene default_scene(const BuiltinScene& builtin)
{
    return builtin.build(complete_parameters(builtin, {}));
}

/// Open surfaces: grounds, planes and the thin wall.
[[nodiscard]] bool is_sheet(const std::string& object, const std::string& scene)
{
    const std::set<std::string> sheets{"ground", "plane", "floor", "terrain"};
    return sheets.contains(object) || (scene == "wall" && object == "wall");
}

TEST(Box, IsClosedWithItsExactVolume)
{
    const TriangleScene scene = scene_of(make_box({-1, 0, 2}, {1, 3, 2.5}));
    const auto report = check_edges(scene, scene.objects.front());
    EXPECT_EQ(scene.triangles.size(), 12U);
    EXPECT_EQ(report.unmatched_edges, 0U);
    EXPECT_EQ(report.signed_volume_m3, 3.0);
}

TEST(Quad, FacesTheSideFromWhichItRunsCounterClockwise)
{
    const TriangleScene scene = scene_of(make_ground({-1, -1}, {1, 1}, 0.5));
    for (std::uint32_t i = 0; i < 2; ++i) {
        const auto corners = scene.corners(i);
        EXPECT_GT(glm::cross(corners[1] - corners[0], corners[2] - corners[0]).y, 0.0F);
    }
    EXPECT_EQ(check_edges(scene, scene.objects.front()).unmatched_edges, 4U);
}

TEST(Sphere, HasTheTrianglesOfItsSlicesAndStacks)
{
    EXPECT_EQ(make_sphere({0, 0, 0}, 1, 128, 65).triangles.size(), 16'384U);
}

TEST(Sphere, IsClosedAndFillsTheVolumeOfItsPolyhedron)
{
    const TriangleScene scene = scene_of(make_sphere({3, 1, -2}, 0.7, 96, 48));
    const auto report = check_edges(scene, scene.objects.front());
    EXPECT_EQ(report.unmatched_edges, 0U);
    const double ball_m3 = 4.0 / 3.0 * std::numbers::pi * 0.7 * 0.7 * 0.7;
    EXPECT_LT(report.signed_volume_m3, ball_m3);
    // An inscribed polyhedron loses about (π/48)²/3·(3/2) of the ball along meridians and
    // (2π/96)²/6 along parallels: 0.3 % together.
    EXPECT_GT(report.signed_volume_m3, 0.995 * ball_m3);
}

TEST(Cylinder, IsAClosedPrismOverARegularPolygon)
{
    const TriangleScene scene = scene_of(make_cylinder({1, 0, 0}, 0.5, 2, 24));
    const auto report = check_edges(scene, scene.objects.front());
    EXPECT_EQ(scene.triangles.size(), 96U);
    EXPECT_EQ(report.unmatched_edges, 0U);
    const double prism_m3 = 2 * 12 * 0.25 * std::sin(2 * std::numbers::pi / 24);
    // Each of 48 corners moves by at most 2^-25 · 2 m in rounding, over an area of 10 m².
    EXPECT_NEAR(report.signed_volume_m3, prism_m3, 1e-6);
}

RC_GTEST_PROP(Prism, OverAnyStaircaseIsClosedWithTheVolumeOfItsOutline, ())
{
    const auto steps =
        *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 8)));
    std::vector<Vec2d> outline{{0, 0}};
    double area_m2 = 0;
    double height_m = 0;
    double x = 0;
    for (const int step : steps) {
        height_m += 0.25 * step;
        x += 0.5;
        area_m2 += 0.5 * height_m;
    }
    outline.emplace_back(x, 0);
    for (std::size_t i = steps.size(); i-- > 0;) {
        outline.emplace_back(0.5 * static_cast<double>(i + 1), height_m);
        outline.emplace_back(0.5 * static_cast<double>(i), height_m);
        height_m -= 0.25 * steps[i];
    }
    const TriangleScene scene = scene_of(make_prism(outline, -1, 1));
    const auto report = check_edges(scene, scene.objects.front());
    RC_ASSERT(scene.dropped_triangles == 0U);
    RC_ASSERT(report.unmatched_edges == 0U);
    // Every coordinate is a multiple of 1/4 below 2^20: the volume is exact but for the sixths.
    RC_ASSERT(std::abs(report.signed_volume_m3 - 2 * area_m2) <= 1e-9 * (1 + area_m2));
}

TEST(Arcade, IsClosedAndTriangulatedWithoutOverlap)
{
    const std::vector<Vec2d> outline = arcade_outline({.arch_count = 3});
    const TriangleScene scene = scene_of(make_prism(outline, 0, 1));
    EXPECT_EQ(check_edges(scene, scene.objects.front()).unmatched_edges, 0U);
    EXPECT_EQ(scene.dropped_triangles, 0U);
    EXPECT_TRUE(coplanar_overlaps(scene).empty());
}

TEST(TurnQuarter, KeepsCoordinatesExactAndOrientation)
{
    Mesh box = make_box({0, 0, 0}, {1, 2, 3});
    turn_quarter(box);
    const TriangleScene scene = scene_of(box);
    EXPECT_EQ(scene.bounds().lower, Vec3d(0, 0, -1));
    EXPECT_EQ(scene.bounds().upper, Vec3d(3, 2, 0));
    EXPECT_EQ(check_edges(scene, scene.objects.front()).signed_volume_m3, 6.0);
}

TEST(CoplanarOverlaps, FindsTwoBoxesOnOneFloor)
{
    Mesh boxes = make_box({0, 0, 0}, {1, 1, 1});
    append(boxes, make_box({0.5, 0, 0.5}, {1.5, 2, 1.5}));
    EXPECT_FALSE(coplanar_overlaps(scene_of(boxes)).empty());
}

TEST(CoplanarOverlaps, ForgivesSharedEdgesAndCrossings)
{
    Mesh boxes = make_box({0, 0, 0}, {1, 1, 1});
    append(boxes, make_box({1, 0, 1}, {2, 1, 2}));             // shares an edge
    append(boxes, make_box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5})); // crosses
    EXPECT_TRUE(coplanar_overlaps(scene_of(boxes)).empty());
}

TEST(BuiltinScene, HasNoTriangleOfZeroArea)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        const TriangleScene scene = default_scene(builtin);
        EXPECT_GT(scene.triangles.size(), 1U) << builtin.name;
        EXPECT_EQ(scene.dropped_triangles, 0U) << builtin.name;
    }
}

/// The usual lane leaves out a million triangles.
bool is_left_out(const BuiltinScene& builtin)
{
    return !tests::runs_full_tests() && builtin.name == "sphere-field";
}

TEST(BuiltinScene, IsMadeOfClosedSolidsTurnedOutside)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        if (is_left_out(builtin)) {
            continue;
        }
        const TriangleScene scene = default_scene(builtin);
        for (const Object& object : scene.objects) {
            if (is_sheet(object.name, builtin.name)) {
                continue;
            }
            const auto report = check_edges(scene, object);
            const bool is_inside_out = object.name == "inner" || object.name == "walls";
            const double inside_out = is_inside_out ? -1.0 : 1.0;
            EXPECT_EQ(report.unmatched_edges, 0U) << builtin.name << ": " << object.name;
            EXPECT_GT(inside_out * report.signed_volume_m3, 0.0)
                << builtin.name << ": " << object.name;
        }
    }
}

TEST(BuiltinScene, HasUpwardGrounds)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        const TriangleScene scene = default_scene(builtin);
        for (const Object& object : scene.objects) {
            if (!is_sheet(object.name, builtin.name) || object.name == "wall") {
                continue;
            }
            for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
                const auto c = scene.corners(object.first_triangle + i);
                ASSERT_GT(glm::cross(c[1] - c[0], c[2] - c[0]).y, 0.0F)
                    << builtin.name << ": " << triangle_name(scene, object.first_triangle + i);
            }
        }
    }
}

TEST(BuiltinScene, HasUniqueObjectNames)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        std::set<std::string> names;
        for (const Object& object : default_scene(builtin).objects) {
            EXPECT_TRUE(names.insert(object.name).second) << builtin.name << ": " << object.name;
        }
    }
}

TEST(BuiltinScene, HasNoCoplanarOverlappingFaces)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        if (is_left_out(builtin)) {
            continue;
        }
        const TriangleScene scene = default_scene(builtin);
        const auto overlaps = coplanar_overlaps(scene);
        ASSERT_TRUE(overlaps.empty())
            << builtin.name << ": " << overlaps.size() << " overlaps, the first "
            << triangle_name(scene, overlaps[0][0]) << " and "
            << triangle_name(scene, overlaps[0][1]);
    }
}

TEST(Wall, HasNoCoplanarOverlappingFacesWhenThick)
{
    const BuiltinScene& builtin = find_builtin_scene("wall");
    const TriangleScene scene = builtin.build(complete_parameters(builtin, {{"thickness_m", 0.1}}));
    EXPECT_TRUE(coplanar_overlaps(scene).empty());
    EXPECT_EQ(check_edges(scene, scene.objects.back()).unmatched_edges, 0U);
}

TEST(Fence, IsOfSheetsWhenItsThicknessIsZero)
{
    const BuiltinScene& builtin = find_builtin_scene("fence");
    const TriangleScene scene = builtin.build(
        complete_parameters(builtin, {{"slat_thickness_m", 0.0}, {"slat_count", 7.0}}));
    ASSERT_EQ(scene.objects.back().name, "slats");
    EXPECT_EQ(scene.objects.back().triangle_count, 14U);
}

} // namespace
} // namespace gnomon::scene
