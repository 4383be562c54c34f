#include "scene/geometry/vertex_normals.hpp"

#include "scene/load/load_scene.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::scene {
namespace {

using Indices = std::array<std::uint32_t, 3>;

glm::dmat3 scaled(double x, double y, double z)
{
    return {Vec3d{x, 0, 0}, Vec3d{0, y, 0}, Vec3d{0, 0, z}};
}

void expect_near(const Vec3d& found, const Vec3d& expected, double tolerance)
{
    EXPECT_LE(glm::length(found - expected), tolerance)
        << found.x << ' ' << found.y << ' ' << found.z;
}

/// One float32's rounding of each component.
constexpr double rounding = 0x1p-24;

TEST(AMovedNormal, FollowsTheInverseTranspose)
{
    // A plane x + y = 0 that becomes twice as wide along x: x/2 + y = 0.
    const Vec3f moved = moved_normal(scaled(2, 1, 1), glm::normalize(Vec3d{1, 1, 0}));
    expect_near(Vec3d{moved}, glm::normalize(Vec3d{0.5, 1, 0}), rounding);
}

TEST(AMovedNormal, StaysOutsideOfAMirroredMesh)
{
    EXPECT_EQ(moved_normal(scaled(-1, 1, 1), {1, 0, 0}), Vec3f(-1, 0, 0));
    EXPECT_EQ(moved_normal(scaled(-1, 1, 1), {0, 1, 0}), Vec3f(0, 1, 0));
    EXPECT_EQ(moved_normal(scaled(-3, -3, -3), {0, 0, 1}), Vec3f(0, 0, -1));
}

TEST(AMovedNormal, KeepsItsBitsWhereNothingMoves)
{
    const Vec3f normal{glm::normalize(Vec3d{0.3, -0.7, 0.2})};
    EXPECT_EQ(moved_normal(glm::dmat3{1}, Vec3d{normal}), normal);
}

TEST(AMovedNormal, IsOfAFlattenedMeshThePlanesAndElseLost)
{
    EXPECT_EQ(moved_normal(scaled(1, 0, 1), {0, 5, 0}), Vec3f(0, 1, 0));
    EXPECT_EQ(moved_normal(scaled(1, 0, 1), {1, 0, 0}), Vec3f(0, 0, 0));
    EXPECT_EQ(moved_normal(scaled(1, 1, 1), {0, 0, 0}), Vec3f(0, 0, 0));
    EXPECT_EQ(moved_normal(scaled(1, 1, 1), {std::nan(""), 0, 1}), Vec3f(0, 0, 0));
}

/// Two squares that share an edge along z, the second turned down by an angle.
TriangleScene folded(double angle_deg)
{
    const double angle_rad = angle_deg * std::numbers::pi / 180;
    const double x = 1 + std::cos(angle_rad);
    const double y = -std::sin(angle_rad);
    const std::array<Vec3d, 6> vertices{Vec3d{0, 0, 0}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0},
                                        Vec3d{1, 0, 1}, Vec3d{x, y, 0}, Vec3d{x, y, 1}};
    const std::array<Indices, 4> triangles{Indices{0, 1, 3}, Indices{0, 3, 2}, Indices{2, 3, 5},
                                           Indices{2, 5, 4}};
    SceneBuilder builder;
    builder.add("fold", vertices, triangles);
    return builder.take();
}

/// The first triangle of the first square: its corner at (1, 0, 1), whose vertex has two triangles
/// of that square and one of the other.
Vec3d normal_at_fold(double angle_deg)
{
    TriangleScene scene = folded(angle_deg);
    complete_vertex_normals(scene);
    return Vec3d{scene.attributes[0][2].normal};
}

TEST(VertexNormals, AreWeighedByAreaAcrossAGentleFold)
{
    const double angle_rad = 30 * std::numbers::pi / 180;
    // Equal areas: two of the first square, one of the second.
    const Vec3d expected =
        glm::normalize(Vec3d{0, 2, 0} + Vec3d{std::sin(angle_rad), std::cos(angle_rad), 0});
    expect_near(normal_at_fold(30), expected, 4 * rounding);
    expect_near(normal_at_fold(-30), {-expected.x, expected.y, 0}, 4 * rounding);
}

TEST(VertexNormals, AreThoseOfTheFaceAtACrease)
{
    EXPECT_GT(normal_at_fold(crease_deg - 1).x, 0.1);
    EXPECT_EQ(normal_at_fold(crease_deg + 1), Vec3d(0, 1, 0));
}

TEST(VertexNormals, ThatAMeshHasStay)
{
    TriangleScene scene = folded(30);
    scene.attributes.resize(1);
    scene.attributes[0][2].normal = {1, 0, 0};
    complete_vertex_normals(scene);
    ASSERT_EQ(scene.attributes.size(), 4U);
    EXPECT_EQ(scene.attributes[0][2].normal, Vec3f(1, 0, 0));
    EXPECT_EQ(scene.attributes[0][0].normal, Vec3f(0, 1, 0));
}

TriangleScene builtin(const char* name)
{
    SceneSettings settings;
    settings.builtin = name;
    return load_scene(settings, VertexNormals::kept).scene;
}

TEST(VertexNormals, OfABuiltInCubeAreItsFaces)
{
    const TriangleScene scene = builtin("sphere-cube");
    std::size_t corners = 0;
    for (const Object& object : scene.objects) {
        if (object.name != "cube") {
            continue;
        }
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            for (const CornerAttributes& corner : scene.attributes[object.first_triangle + t]) {
                const Vec3f size = glm::abs(corner.normal);
                EXPECT_EQ(std::max({size.x, size.y, size.z}), 1.0F);
                ++corners;
            }
        }
    }
    EXPECT_EQ(corners, 36U);
}

// A sphere of latitudes and longitudes: the mean of its faces leans to the wider ones, towards the
// equator, by at most the angle between two rings.
TEST(VertexNormals, OfABuiltInSpherePointFromItsCentre)
{
    const TriangleScene scene = builtin("sphere-plane");
    for (const Object& object : scene.objects) {
        if (object.name != "sphere") {
            continue;
        }
        Vec3d lower{1e9};
        Vec3d upper{-1e9};
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            for (const Vec3f& corner : scene.corners(object.first_triangle + t)) {
                lower = glm::min(lower, Vec3d{corner});
                upper = glm::max(upper, Vec3d{corner});
            }
        }
        const Vec3d centre = 0.5 * (lower + upper);
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            const auto corners = scene.corners(object.first_triangle + t);
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3d outward = glm::normalize(Vec3d{corners.at(k)} - centre);
                const Vec3d normal{scene.attributes[object.first_triangle + t].at(k).normal};
                ASSERT_GE(glm::dot(outward, normal), std::cos(0.03)) << "triangle " << t;
            }
        }
        return;
    }
    FAIL() << "no sphere";
}

TEST(VertexNormals, AreKeptOnlyWhereTheyAreAskedFor)
{
    SceneSettings settings;
    settings.builtin = "wall";
    settings.ground = true;
    const TriangleScene without = load_scene(settings).scene;
    const TriangleScene with = load_scene(settings, VertexNormals::kept).scene;
    EXPECT_TRUE(without.attributes.empty());
    EXPECT_EQ(with.attributes.size(), with.triangles.size());
    EXPECT_EQ(with.attributes.back()[0].normal, Vec3f(0, 1, 0)) << "the ground's";
    EXPECT_EQ(content_hash(with), content_hash(without)) << "truth does not depend on them";
    EXPECT_EQ(normals_hash(without), "");
    TriangleScene other = with;
    other.attributes.back()[0].normal = {1, 0, 0};
    EXPECT_NE(normals_hash(other), normals_hash(with));
}

TEST(VertexNormals, MustBeOfEveryTriangle)
{
    const std::array<Vec3d, 3> vertices{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}};
    const std::array<Indices, 1> triangles{Indices{0, 1, 2}};
    const std::array<TriangleAttributes, 2> attributes{};
    SceneBuilder builder;
    EXPECT_THROW(builder.add("a", vertices, triangles, attributes), std::invalid_argument);
}

TEST(VertexNormals, OfDroppedTrianglesAreDropped)
{
    const std::array<Vec3d, 3> vertices{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}};
    const std::array<Indices, 2> triangles{Indices{0, 0, 1}, Indices{0, 1, 2}};
    std::array<TriangleAttributes, 2> attributes{};
    attributes[1][0].normal = {1, 0, 0};
    SceneBuilder builder;
    builder.add("before", vertices, std::span{triangles}.last(1)); // has none
    builder.add("a", vertices, triangles, attributes);
    const TriangleScene scene = builder.take();
    ASSERT_EQ(scene.attributes.size(), 2U);
    EXPECT_EQ(scene.attributes[0][0].normal, Vec3f(0, 0, 0));
    EXPECT_EQ(scene.attributes[1][0].normal, Vec3f(1, 0, 0));
}

class InterpolatedNormal : public testing::Test {
protected:
    void SetUp() override
    {
        scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}; // faces +z
        scene.triangles = {{0, 1, 2}};
        scene.objects = {{"a", 0, 1}};
        scene.attributes = {{{{{0, 0, 1}}, {{0.6F, 0, 0.8F}}, {{0, 0.6F, 0.8F}}}}};
    }
    TriangleScene scene;
};

TEST_F(InterpolatedNormal, IsTheCornersOwnAndBetweenThemTheMean)
{
    expect_near(vertex_normal_at(scene, 0, {1, 0, 0}), {0.6, 0, 0.8}, 4 * rounding);
    expect_near(vertex_normal_at(scene, 0, {0, 1, 0}), {0, 0.6, 0.8}, 4 * rounding);
    expect_near(vertex_normal_at(scene, 0, {0.5, 0.5, 0}), glm::normalize(Vec3d{0.3, 0.3, 0.8}),
                4 * rounding);
}

TEST_F(InterpolatedNormal, IsOnTheSideOfTheWinding)
{
    for (CornerAttributes& corner : scene.attributes[0]) {
        corner.normal = -corner.normal;
    }
    expect_near(vertex_normal_at(scene, 0, {1, 0, 0}), {0.6, 0, 0.8}, 4 * rounding);
}

TEST_F(InterpolatedNormal, IsTheTrianglesWhereTheCornersCancelOut)
{
    scene.attributes = {{{{{0, 0, 1}}, {{0, 0, 1}}, {{0, 0, -1}}}}};
    EXPECT_EQ(vertex_normal_at(scene, 0, {0.25, 0.5, 0}), Vec3d(0, 0, 1));
}

} // namespace
} // namespace gnomon::scene
