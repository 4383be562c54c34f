#include "reference_rt/rounded/rounded_truth.hpp"

#include "scene_fixture.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

/// Which triangle is nearest to a point.
namespace gnomon::reference_rt::test {
namespace {

TEST(NearestSurfaces, SearchNoFartherThanTheirScope)
{
    const ReferenceScene reference{plate_over_ground()};
    const std::vector<Vec3d> points{{0.25, 0.25, 0.5}, {0.25, 0.25, 0.5}, {0.25, 0.25, 0.5}};
    const std::vector<scene::SurfaceScope> scopes{{scene::no_object, 0.25}, {1, 0.5}, {1, 0.75}};
    const auto found = nearest_surfaces(reference, points, scopes);
    EXPECT_EQ(found[0].distance_m, 0.25);
    EXPECT_EQ(found[1].triangle, no_triangle);
    EXPECT_EQ(found[2].distance_m, 0.75);
    EXPECT_THROW(static_cast<void>(nearest_surfaces(reference, points, std::span{scopes}.first(1))),
                 std::invalid_argument);
}

TEST(NearestSurfaces, AgreesWithTryingEveryTriangle)
{
    std::mt19937 random{31};
    std::uniform_real_distribution<double> place{-2, 2};
    SceneBuilder builder;
    add_sphere(builder, {0, 0, 0}, 1, 6);
    add_box(builder, {1, 0, -1}, {1.5, 0.75, 1});
    const TriangleScene scene = builder.take();
    std::vector<Vec3d> points;
    for (int i = 0; i < 150; ++i) {
        // A few far outside the scene's box.
        points.push_back((i % 10 == 0 ? 100.0 : 1.0) *
                         Vec3d{place(random), place(random), place(random)});
    }
    const auto found = nearest_surfaces(ReferenceScene{scene}, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        // Barycentric search in rationals would say the same; a dense sampling bounds it from
        // above.
        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
            const auto [a, b, c] = scene.corners(t);
            for (int u = 0; u <= 24; ++u) {
                for (int v = 0; u + v <= 24; ++v) {
                    const Vec3d sample = Vec3d{a} + u / 24.0 * (Vec3d{b} - Vec3d{a}) +
                                         v / 24.0 * (Vec3d{c} - Vec3d{a});
                    nearest = std::min(nearest, glm::length(points[i] - sample));
                }
            }
        }
        EXPECT_LE(found[i].distance_m, nearest * (1 + 1e-12)) << "point " << i;
        // No triangle's edge is longer than 2.1 m: samples are within 2.1/24 of any of its points.
        EXPECT_GE(found[i].distance_m, nearest - 2.1 / 24) << "point " << i;
    }
}

} // namespace
} // namespace gnomon::reference_rt::test
