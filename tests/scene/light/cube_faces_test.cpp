// The faces of a cube around a point light, and lookups across their seams.

#include "scene/light/cube_faces.hpp"
#include "scene/light/fit_frustum.hpp"
#include "scene/light/map_choice.hpp"
#include "scene/pixels/map_texels.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>
#include <tuple>

namespace gnomon::scene {
namespace {

Vec3d along(const WorldAxis& axis)
{
    return {axis[0], axis[1], axis[2]};
}

const CubeFace& face_of(int map)
{
    return cube_faces.at(static_cast<std::size_t>(map));
}

/// The position of a texel's centre on the cube of half side n, also beyond its face's sides.
Vec3d centre_of(const Texel& texel, int n)
{
    const CubeFace& face = face_of(texel.map);
    return double(n) * along(face.forward) + double(2 * texel.x + 1 - n) * along(face.right) +
           double(2 * texel.y + 1 - n) * along(face.up);
}

TEST(CubeFaces, AreSeenFromInside)
{
    for (const CubeFace& face : cube_faces) {
        EXPECT_EQ(glm::cross(along(face.right), along(face.up)), -along(face.forward)) << face.name;
    }
}

/// OpenGL 4.6 core, table 8.19: the major axis, and s and t of a direction on it.
TEST(CubeFaces, AreOrientedAsGlsOwn)
{
    const Vec3d r{0.3, -0.2, 0.1};
    const std::array<std::array<double, 2>, 6> expected{
        {{-r.z, -r.y}, {r.z, -r.y}, {r.x, r.z}, {r.x, -r.z}, {r.x, -r.y}, {-r.x, -r.y}}};
    for (std::size_t i = 0; i < cube_faces.size(); ++i) {
        EXPECT_EQ(glm::dot(along(cube_faces[i].right), r), expected[i][0]) << cube_faces[i].name;
        EXPECT_EQ(glm::dot(along(cube_faces[i].up), r), expected[i][1]) << cube_faces[i].name;
    }
}

TEST(CubeFaces, AreChosenByTheGreatestComponentTheFirstOfEqualOnes)
{
    EXPECT_EQ(cube_face_towards({1, 0.5F, -0.5F}), 0U);
    EXPECT_EQ(cube_face_towards({-1, 0.5F, -0.5F}), 1U);
    EXPECT_EQ(cube_face_towards({0, 1, -0.5F}), 2U);
    EXPECT_EQ(cube_face_towards({0, -1, -0.5F}), 3U);
    EXPECT_EQ(cube_face_towards({0, 0, 2}), 4U);
    EXPECT_EQ(cube_face_towards({0, 0, -2}), 5U);
    EXPECT_EQ(cube_face_towards({1, 1, 1}), 0U);
    EXPECT_EQ(cube_face_towards({-1, 1, 1}), 1U);
    EXPECT_EQ(cube_face_towards({0.5F, 1, 1}), 2U);
    EXPECT_EQ(cube_face_towards({0.5F, -1, 1}), 3U);
    EXPECT_EQ(cube_face_towards({0.5F, -1, -1}), 3U);
    EXPECT_EQ(cube_face_towards({0, 0, 0}), 0U);
}

TriangleScene some_triangles(const Vec3d& around, double reach_m)
{
    std::mt19937 random{11};
    std::uniform_real_distribution<double> metres{-reach_m, reach_m};
    SceneBuilder builder;
    for (int i = 0; i < 40; ++i) {
        std::array<Vec3d, 3> corners{};
        for (Vec3d& corner : corners) {
            corner = around + Vec3d{metres(random), metres(random), metres(random)};
        }
        constexpr std::array<std::array<std::uint32_t, 3>, 1> triangles{{{0, 1, 2}}};
        builder.add("triangle", corners, triangles);
    }
    return builder.take();
}

Light point_light(const Vec3d& position)
{
    Light light;
    light.type = LightType::point;
    light.position = rounded_to_float32(position);
    return light;
}

/// Rows of x, y and w hold 0, ±1 and ± the light's coordinates, so that x/w and y/w are quotients
/// of components of P − L, whatever the order of the sums.
TEST(CubeMaps, HaveExactRows)
{
    const Light light = point_light({0.1, -2.7, 1e3});
    const auto maps = fit_cube_faces({}, light, some_triangles(light.position, 4));
    ASSERT_EQ(maps.size(), 6U);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Mat4d columns{maps[i].light_clip_from_world};
        const CubeFace& face = cube_faces[i];
        const std::array<std::tuple<int, Vec3d>, 3> rows{
            {{0, along(face.right)}, {1, along(face.up)}, {3, along(face.forward)}}};
        for (const auto& [row, axis] : rows) {
            EXPECT_EQ((Vec3d{columns[0][row], columns[1][row], columns[2][row]}), axis);
            EXPECT_EQ(columns[3][row], -glm::dot(axis, light.position));
        }
        EXPECT_EQ(maps[i].near_m, maps[0].near_m);
        EXPECT_EQ(maps[i].far_m, maps[0].far_m);
    }
}

TEST(CubeMaps, EncloseAllTriangles)
{
    for (const Vec3d& at : {Vec3d{0, 0, 0}, Vec3d{100, -3, 7}}) {
        const Light light = point_light(at);
        const TriangleScene scene = some_triangles(light.position, 4);
        const auto maps = fit_cube_faces({}, light, scene);
        for (const Vec3f& vertex : scene.vertices) {
            const std::size_t map = chosen_map(maps, MapChoice::cube_face, {}, vertex);
            const double distance_m = maps[map].light_distance_m(Vec3d{vertex});
            EXPECT_LE(distance_m, maps[map].far_m);
            EXPECT_GE(distance_m, std::min(maps[map].near_m, 1e-3 * maps[map].far_m));
        }
        // Beyond the padding, far has a margin for the matrix's rounding, which grows with 1/near.
        EXPECT_LT(maps[0].far_m, 4 * 1.03);
    }
}

TEST(CubeMaps, OfDistancesHaveRoomForTheFarthestVertex)
{
    FrustumSettings settings;
    settings.content = MapContent::distance;
    const Light light = point_light({0.3, 1, 2});
    const TriangleScene scene = some_triangles(light.position, 4);
    const auto maps = fit_cube_faces(settings, light, scene);
    double farthest_m = 0;
    for (const Vec3f& vertex : scene.vertices) {
        farthest_m = std::max(farthest_m, glm::length(Vec3d{vertex} - light.position));
    }
    EXPECT_GT(maps[0].far_m, farthest_m);
    EXPECT_LT(maps[0].far_m, 1.001 * farthest_m);
    EXPECT_EQ(maps[0].far_m, double{static_cast<float>(maps[0].far_m)}); // GL's own
    EXPECT_EQ(maps[0].stored_range().near_m, 0);
    EXPECT_EQ(maps[0].stored_range().far_m, maps[0].far_m);
}

TEST(CubeMaps, TakeTheGivenPlanes)
{
    FrustumSettings settings;
    settings.near_m = 0.25;
    settings.far_m = 30;
    settings.reversed = true;
    const Light light = point_light({1, 2, 3});
    const auto maps = fit_cube_faces(settings, light, some_triangles({0, 0, 0}, 4));
    for (const LightFrustum& map : maps) {
        EXPECT_EQ(map.near_m, 0.25);
        EXPECT_EQ(map.far_m, 30);
        EXPECT_TRUE(map.reversed);
        EXPECT_EQ(map.clip_range, ClipRange::zero_to_one);
    }
}

/// docs/point_lights.md, "A spot in place of a face".
TEST(ASpot, CanHaveTheMapOfAFace)
{
    const Vec3d at{0.3, 1.9, 0.2};
    FrustumSettings settings;
    settings.near_m = 0.8;
    settings.far_m = 3.3;
    const TriangleScene scene = some_triangles(at, 4);
    const auto faces = fit_cube_faces(settings, point_light(at), scene);
    settings.fit = Fit::fixed;
    settings.fov_deg = 90;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        settings.roll_deg = cube_faces[i].name == "+y" ? 0 : 180;
        LightSettings light;
        light.type = LightType::spot;
        light.position = at;
        light.target = at + along(cube_faces[i].forward);
        const LightFrustum spot =
            fit_light_frustum(settings, light, make_light(light), scene, {}, {64, 64});
        EXPECT_EQ(spot.light_clip_from_world, faces[i].light_clip_from_world) << cube_faces[i].name;
    }
}

TEST(CubeTexels, OfAFaceAreItsOwn)
{
    EXPECT_EQ(texel_across_seams({0, 3, 4}, 4), (Texel{0, 3, 4}));
    EXPECT_EQ(texel_across_seams({0, 0, 2}, 1), (Texel{0, 0, 2}));
}

TEST(CubeTexels, BeyondASideAreTheNeighboursByHand)
{
    // +x grows towards −z: beyond its right side comes −z, whose x grows towards −x: its left
    // column.
    EXPECT_EQ(texel_across_seams({4, 1, 0}, 4), (Texel{0, 1, 5}));
    EXPECT_EQ(texel_across_seams({5, 1, 0}, 4), (Texel{1, 1, 5}));
    EXPECT_EQ(texel_across_seams({-1, 1, 0}, 4), (Texel{3, 1, 4}));
    // v of +x grows towards −y; −y has x to the right, and z downwards.
    EXPECT_EQ(texel_across_seams({0, 4, 0}, 4), (Texel{3, 0, 3}));
    EXPECT_EQ(texel_across_seams({3, 5, 0}, 4), (Texel{2, 3, 3}));
}

TEST(CubeTexels, BeyondTwoSidesAreAcrossTheOneThatIsFarther)
{
    EXPECT_EQ(texel_across_seams({4, 4, 0}, 4), texel_across_seams({4, 3, 0}, 4));
    EXPECT_EQ(texel_across_seams({4, 6, 0}, 4), texel_across_seams({3, 6, 0}, 4));
    EXPECT_EQ(texel_across_seams({6, -1, 0}, 4), texel_across_seams({6, 0, 0}, 4));
}

/// Every step across a seam leads to an adjacent texel of the neighbouring face, and back.
TEST(CubeTexels, LeadOverEverySeamAndBack)
{
    for (const int n : {1, 2, 3, 8, 101, 16384}) {
        for (int map = 0; map < 6; ++map) {
            for (const int along_side : {0, n / 3, n - 1}) {
                for (const Texel inside :
                     {Texel{0, along_side, map}, Texel{n - 1, along_side, map},
                      Texel{along_side, 0, map}, Texel{along_side, n - 1, map}}) {
                    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                        const Texel beyond{inside.x + dx, inside.y + dy, map};
                        if (beyond.x >= 0 && beyond.x < n && beyond.y >= 0 && beyond.y < n) {
                            continue;
                        }
                        const Texel next = texel_across_seams(beyond, n);
                        SCOPED_TRACE(testing::Message() << "n " << n << " map " << map << " texel "
                                                        << beyond.x << ' ' << beyond.y);
                        EXPECT_NE(next.map, map);
                        EXPECT_EQ(cube_face_towards(Vec3f{centre_of(beyond, n)}),
                                  static_cast<std::size_t>(next.map));
                        // Half a texel on either side of the edge.
                        EXPECT_NEAR(glm::distance(centre_of(next, n), centre_of(inside, n)),
                                    std::sqrt(2.0), 1e-9);
                        std::set<std::tuple<int, int, int>> around;
                        for (const auto& [bx, by] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                            const Texel back =
                                texel_across_seams({next.x + bx, next.y + by, next.map}, n);
                            around.insert({back.x, back.y, back.map});
                        }
                        EXPECT_TRUE(around.contains({inside.x, inside.y, inside.map}));
                    }
                }
            }
        }
    }
}

TEST(CubeTexels, AreOnTheirFaces)
{
    std::mt19937 random{12};
    for (int i = 0; i < 100'000; ++i) {
        const int n = std::uniform_int_distribution{1, 40}(random);
        std::uniform_int_distribution<int> coordinate{-n, 2 * n - 1};
        const Texel texel{coordinate(random), coordinate(random),
                          std::uniform_int_distribution{0, 5}(random)};
        const Texel found = texel_across_seams(texel, n);
        ASSERT_TRUE(found.x >= 0 && found.x < n && found.y >= 0 && found.y < n && found.map >= 0 &&
                    found.map < 6)
            << "n " << n << ", map " << texel.map << ", texel " << texel.x << ' ' << texel.y;
    }
}

} // namespace
} // namespace gnomon::scene
