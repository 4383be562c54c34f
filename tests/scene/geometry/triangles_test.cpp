#include "scene/geometry/triangles.hpp"

#include "scene/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::scene {
namespace {

using Corner = std::array<std::uint32_t, 3>;
using testing::HasSubstr;
using testing::ThrowsMessage;

TriangleScene one_object(const std::vector<Vec3d>& vertices, const std::vector<Corner>& triangles)
{
    SceneBuilder builder;
    builder.add("thing", vertices, triangles);
    return builder.take();
}

TEST(SceneBuilder, RoundsEachCoordinateOnce)
{
    const auto scene = one_object({{0.1, 0, 0}, {1, 1e-50, 0}, {0, 1, -0.0}}, {{0, 1, 2}});
    EXPECT_EQ(scene.vertices[0].x, 0.1F);
    EXPECT_EQ(scene.vertices[1].y, 0.0F);
    EXPECT_FALSE(std::signbit(scene.vertices[2].z)) << "negative zero must not differ from zero";
}

TEST(SceneBuilder, CanonicalisesSubnormalsToZero)
{
    const auto scene = one_object({{1e-40, 0, 0}, {1, -1e-41, 0}, {0, 1, 0}}, {{0, 1, 2}});
    EXPECT_EQ(scene.vertices[0].x, 0.0F);
    EXPECT_EQ(scene.vertices[1].y, 0.0F);
}

TEST(SceneBuilder, DropsAndCountsTrianglesOfExactlyZeroArea)
{
    // Collinear far from the origin; two equal corners; and a sliver that is thin but not flat.
    const auto scene = one_object({{1e6, 1e6, 1e6},
                                   {2e6, 2e6, 2e6},
                                   {3e6, 3e6, 3e6},
                                   {1, 0, 0},
                                   {2, 0, 0},
                                   {3, std::ldexp(1.0, -100), 0}},
                                  {{0, 1, 2}, {0, 1, 1}, {3, 4, 5}});
    EXPECT_EQ(scene.dropped_triangles, 2U);
    EXPECT_EQ(scene.triangles.size(), 1U);
    EXPECT_EQ(scene.vertices.size(), 3U) << "vertices of dropped triangles go too";
}

TEST(SceneBuilder, KeepsObjectsContiguousAndFindsThem)
{
    SceneBuilder builder;
    const std::vector<Vec3d> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    builder.add("a", vertices, std::vector<Corner>{{0, 1, 2}, {0, 1, 3}});
    builder.add("empty", vertices, {});
    builder.add("b", vertices, std::vector<Corner>{{1, 2, 3}});
    const auto scene = builder.take();
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[scene.object_of(0)].name, "a");
    EXPECT_EQ(scene.objects[scene.object_of(1)].name, "a");
    EXPECT_EQ(scene.objects[scene.object_of(2)].name, "b");
}

TEST(SceneBuilder, RefusesCoordinatesThatAreNotFiniteOrTooLarge)
{
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1.01e15}) {
        EXPECT_THAT(
            [&] {
                (void)one_object({{0, 0, 0}, {1, 0, 0}, {0, bad, 0}}, {{0, 1, 2}});
            },
            ThrowsMessage<InputError>(testing::AllOf(HasSubstr("thing"), HasSubstr("vertex 2"))));
    }
    EXPECT_NO_THROW((void)one_object({{0, 0, 0}, {1, 0, 0}, {0, 1e15, 0}}, {{0, 1, 2}}));
}

TEST(SceneBuilder, RefusesAnIndexOutOfRange)
{
    EXPECT_THAT(
        [] {
            (void)one_object({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}});
        },
        ThrowsMessage<InputError>(HasSubstr("index 3 of 3")));
}

TEST(Ranges, MergeNeighboursWithTheSameRole)
{
    SceneBuilder builder;
    const std::vector<Vec3d> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const char* name : {"a", "b", "c", "d"}) {
        builder.add(name, vertices, std::vector<Corner>{{0, 1, 2}});
    }
    auto scene = builder.take();
    EXPECT_EQ(casting_ranges(scene).size(), 1U);
    set_roles(scene, std::vector<std::string>{"b"}, std::vector<std::string>{"a", "d"});
    const auto casting = casting_ranges(scene);
    ASSERT_EQ(casting.size(), 2U);
    EXPECT_EQ(casting[1].first, 2U);
    EXPECT_EQ(casting[1].count, 2U);
    const auto receiving = receiving_ranges(scene);
    ASSERT_EQ(receiving.size(), 1U);
    EXPECT_EQ(receiving[0].first, 1U);
    EXPECT_EQ(receiving[0].count, 2U);
}

TEST(SetRoles, NamesTheNearestObject)
{
    auto scene = one_object({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    EXPECT_THAT(
        [&] { set_roles(scene, std::vector<std::string>{"thong"}, {}); },
        ThrowsMessage<InputError>(testing::AllOf(HasSubstr("no_cast"), HasSubstr("\"thing\""))));
}

TEST(Ground, IsNumberedWhereAnObjectHasItsName)
{
    auto scene = one_object({{0, 1, 0}, {1, 1, 0}, {0, 3, 0}}, {{0, 1, 2}});
    scene.objects.front().name = "ground";
    add_ground(scene);
    EXPECT_EQ(scene.objects.back().name, "ground.2");
    set_roles(scene, std::vector<std::string>{"ground.2"}, {});
    EXPECT_TRUE(scene.objects.front().casts);
    EXPECT_FALSE(scene.objects.back().casts);
}

TEST(Ground, LiesUnderTheBoxAndFacesUp)
{
    auto scene = one_object({{0, 1, 0}, {1, 1, 0}, {0, 3, 0}}, {{0, 1, 2}});
    add_ground(scene);
    ASSERT_EQ(scene.objects.back().name, "ground");
    ASSERT_EQ(scene.objects.back().triangle_count, 2U);
    for (std::uint32_t t = 1; t < 3; ++t) {
        const auto c = scene.corners(t);
        EXPECT_EQ(c[0].y, 1.0F);
        const Vec3f normal = glm::cross(c[1] - c[0], c[2] - c[0]);
        EXPECT_GT(normal.y, 0.0F);
    }
}

TEST(Bounds, RefuseASceneOfNothing)
{
    EXPECT_THROW((void)TriangleScene{}.bounds(), InputError);
}

TEST(ContentHash, ChangesWithVerticesIndicesNamesAndRoles)
{
    const std::vector<Vec3d> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto scene = one_object(vertices, {{0, 1, 2}});
    EXPECT_EQ(content_hash(scene), content_hash(one_object(vertices, {{0, 1, 2}})));
    EXPECT_NE(content_hash(scene), content_hash(one_object(vertices, {{1, 0, 2}})));
    auto renamed = scene;
    renamed.objects[0].name = "other";
    auto silent = scene;
    silent.objects[0].casts = false;
    auto moved = scene;
    moved.vertices[0].x = 0.5F;
    for (const auto& changed : {renamed, silent, moved}) {
        EXPECT_NE(content_hash(scene), content_hash(changed));
    }
}

} // namespace
} // namespace gnomon::scene
