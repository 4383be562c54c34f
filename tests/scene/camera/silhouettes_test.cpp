#include "scene/camera/silhouettes.hpp"

#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::scene {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Camera camera_at(const Vec3d& eye, Projection projection = Projection::perspective)
{
    return make_camera({.eye = eye,
                        .target = {0, 0, 0},
                        .up = {0, 1, 0},
                        .projection = projection,
                        .vertical_fov_deg = 90,
                        .orthographic_height_m = 8});
}

/// A cube of side 2 about the origin.
TriangleScene cube()
{
    std::vector<Vec3d> corners;
    for (unsigned i = 0; i < 8; ++i) {
        corners.emplace_back((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1,
                             (i & 4U) != 0 ? 1 : -1);
    }
    SceneBuilder builder;
    builder.add("cube", corners,
                Triangles{{0, 2, 3},
                          {0, 3, 1},
                          {4, 5, 7},
                          {4, 7, 6},
                          {0, 1, 5},
                          {0, 5, 4},
                          {2, 6, 7},
                          {2, 7, 3},
                          {0, 4, 6},
                          {0, 6, 2},
                          {1, 3, 7},
                          {1, 7, 5}});
    return builder.take();
}

TriangleScene triangles_of(const std::vector<Vec3d>& corners, const Triangles& triangles)
{
    SceneBuilder builder;
    builder.add("sheet", corners, triangles);
    return builder.take();
}

TEST(SilhouetteEdges, OfACubeAreThoseBetweenSeenAndUnseenFaces)
{
    EXPECT_EQ(silhouette_edges(cube(), camera_at({0, 0, 5})).size(), 4U); // one face is seen
    EXPECT_EQ(silhouette_edges(cube(), camera_at({5, 0, 5})).size(), 6U); // two
    EXPECT_EQ(silhouette_edges(cube(), camera_at({5, 4, 3})).size(), 6U); // three
    // Parallel rays see the sides edge-on: all their edges count, except the diagonals of front and
    // back.
    EXPECT_EQ(silhouette_edges(cube(), camera_at({0, 0, 5}, Projection::orthographic)).size(),
              12U + 4U);
}

TEST(SilhouetteEdges, AreABordersAndThoseOfThreeTriangles)
{
    const std::vector<Vec3d> corners{
        {0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0.3, 1}};
    const Camera camera = camera_at({0, 0, 5});
    EXPECT_EQ(silhouette_edges(triangles_of(corners, {{0, 1, 2}}), camera).size(), 3U);
    // The shared edge of two adjacent triangles is no silhouette, whatever their winding.
    EXPECT_EQ(silhouette_edges(triangles_of(corners, {{0, 1, 2}, {0, 3, 1}}), camera).size(), 4U);
    EXPECT_EQ(silhouette_edges(triangles_of(corners, {{0, 1, 2}, {0, 1, 3}}), camera).size(), 4U);
    // A double-sided triangle is one surface.
    EXPECT_EQ(silhouette_edges(triangles_of(corners, {{0, 1, 2}, {0, 3, 1}, {2, 1, 0}, {1, 3, 0}}),
                               camera)
                  .size(),
              4U);
    // A third triangle on the edge hides part of one of them.
    EXPECT_EQ(
        silhouette_edges(triangles_of(corners, {{0, 1, 2}, {0, 3, 1}, {0, 1, 4}}), camera).size(),
        7U);
}

TEST(SilhouetteEdges, KnowVerticesByTheirPlaceAndReceiversAlone)
{
    // The same two triangles, with the shared corners given twice.
    const std::vector<Vec3d> split{{0, 0, 0}, {1, 0, 0},    {0.5, 1, 0},
                                   {0, 0, 0}, {0.5, -1, 0}, {1, 0, 0}};
    TriangleScene scene = triangles_of(split, {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(silhouette_edges(scene, camera_at({0, 0, 5})).size(), 4U);
    scene.objects.front().receives = false;
    EXPECT_TRUE(silhouette_edges(scene, camera_at({0, 0, 5})).empty());
}

/// "x,y" of each marked pixel, row by row.
std::string marked(const std::vector<Edge>& edges, const Camera& camera, double margin_px = 0,
                   double farthest_m = infinity)
{
    const Image<std::uint8_t> marks =
        pixels_of_edges(edges, camera, margin_px, 1e-3, Image<double>{{8, 8}, farthest_m});
    std::string text;
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            text += marks(x, y) != 0 ? std::to_string(x) + "," + std::to_string(y) + " " : "";
        }
    }
    return text;
}

/// With 8 × 8 pixels that show 8 × 8 m of the plane z = 0, for both projections.
TEST(PixelsOfEdges, AreThoseWhoseSquaresAreCrossed)
{
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        const Camera camera = camera_at({0, 0, 4}, projection);
        // From the pixel (1, 2) to the pixel (3, 2), y downwards.
        EXPECT_EQ(marked({{Vec3d{-2.5, 1.5, 0}, {-0.5, 1.5, 0}}}, camera), "1,2 2,2 3,2 ");
        EXPECT_EQ(marked({{Vec3d{-2.5, 1.5, 0}, {-2.5, -0.5, 0}}}, camera), "1,2 1,3 1,4 ");
        EXPECT_EQ(marked({{Vec3d{-0.5, 1.6, 0}, {-2.5, 0.6, 0}}}, camera), "2,2 3,2 1,3 2,3 ");
        // A point, and an edge that runs off the image on both sides.
        EXPECT_EQ(marked({{Vec3d{3.5, -3.5, 0}, {3.5, -3.5, 0}}}, camera), "7,7 ");
        EXPECT_EQ(marked({{Vec3d{-1e9, 3.5, 0}, {1e9, 3.5, 0}}}, camera),
                  "0,0 1,0 2,0 3,0 4,0 5,0 6,0 7,0 ");
        EXPECT_EQ(marked({{Vec3d{9, 0.5, 0}, {9, 3, 0}}}, camera), "");
    }
}

TEST(PixelsOfEdges, GrowByTheMargin)
{
    const Camera camera = camera_at({0, 0, 4}, Projection::orthographic);
    const std::vector<Edge> edge{{Vec3d{-2.5, 1.9, 0}, {-2.5, 1.5, 0}}}; // 0.1 px below row 1
    EXPECT_EQ(marked(edge, camera, 0.0625), "1,2 ");
    EXPECT_EQ(marked(edge, camera, 0.125), "1,1 1,2 ");
}

TEST(PixelsOfEdges, AreNotBehindWhatIsSeenNorBehindTheCamera)
{
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        const Camera camera = camera_at({0, 0, 4}, projection);
        const std::vector<Edge> edge{{Vec3d{-2.5, 1.5, 0}, {-2.5, 1.5, 0}}};
        EXPECT_EQ(marked(edge, camera, 0, 4), "1,2 ");
        EXPECT_EQ(marked(edge, camera, 0, 3.999), "");
        EXPECT_EQ(marked({{Vec3d{0.5, 0.5, 4.5}, {0.5, 0.5, 5}}}, camera), "");
    }
    // One that passes the camera is seen as far as the near plane.
    const Camera camera = camera_at({0, 0, 4});
    EXPECT_EQ(marked({{Vec3d{0.4, -0.55, 0}, {0.4, -0.55, 8}}}, camera),
              "4,4 4,5 5,5 5,6 6,6 6,7 ");
}

} // namespace
} // namespace gnomon::scene
