// The first triangles of a camera's pixels, and the pixels at silhouettes.

#include "scene_fixture.hpp"

#include "scene/camera/silhouettes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::reference_rt::test {
namespace {

using scene::Projection;

/// Boxes, balls and plates over a ground, some behind others, some through each other.
TriangleScene solids()
{
    SceneBuilder builder;
    add_ground(builder, 4, 6);
    add_box(builder, {-1.5, 0, -1.5}, {-0.5, 1.5, -0.25});
    add_box(builder, {0.5, 0.25, 0.5}, {0.75, 2, 0.75}, "pole");
    add_sphere(builder, {0.75, 0.5, -1}, 0.75, 6);
    builder.add("plate", std::vector<Vec3d>{{-1, 2, 1}, {1, 2.5, 1}, {1, 2.5, -1}, {-1, 2, -1}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
    return builder.take();
}

std::vector<View> views(ImageSize image)
{
    std::vector<View> all;
    for (const Vec3d& eye :
         {Vec3d{3, 4, 5}, Vec3d{-5, 1, 2}, Vec3d{0.5, 6, 0.25}, Vec3d{2, 0.8, -6}}) {
        for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
            all.push_back(make_view(eye, {0, 0.7, 0}, image, directional({0, -1, 0}), projection));
        }
    }
    return all;
}

TEST(FirstTriangles, AreThoseThatAllTrianglesInTurnGive)
{
    const TriangleScene scene = solids();
    const ReferenceScene reference{scene};
    int seen = 0;
    for (const View& view : views({64, 48})) {
        const auto expected = brute_force_receivers(scene, view);
        const auto first = first_triangles(reference, view);
        const auto points = receiver_points(scene, view, first);
        for (std::size_t i = 0; i < first.pixel_count(); ++i) {
            if (first[i] == expected[i]) {
                seen += first[i] != no_triangle ? 1 : 0;
                continue;
            }
            // Brute force is in double: on an edge it may choose the neighbour, at the same point.
            ASSERT_NE(first[i], no_triangle);
            ASSERT_NE(expected[i], no_triangle);
            const auto other = receiver_points(scene, view, expected)[i];
            EXPECT_LT(glm::length(Vec3d{points[i]} - Vec3d{other}), 1e-6) << "pixel " << i;
        }
    }
    EXPECT_GT(seen, 10000);
}

/// The first triangles at the pixel centres of a finer image.
struct Samples {
    Image<std::uint32_t> triangle;
    Image<scene::Vec3f> point;
};

/// The distance of a sample's point from the plane of another sample's triangle [m].
double off_plane_m(const TriangleScene& scene, const Samples& samples, std::size_t of,
                   std::size_t point)
{
    const auto [a, b, c] = scene.corners(samples.triangle[of]);
    const Vec3d normal = glm::normalize(glm::cross(Vec3d{b} - Vec3d{a}, Vec3d{c} - Vec3d{a}));
    return std::abs(glm::dot(normal, Vec3d{samples.point[point]} - Vec3d{a}));
}

/// Whether a surface ends between two adjacent samples: across a shared edge, each point would be
/// near the other's plane.
bool is_end(const TriangleScene& scene, const Samples& samples, std::size_t a, std::size_t b)
{
    if (samples.triangle[a] == no_triangle || samples.triangle[b] == no_triangle) {
        return samples.triangle[a] != samples.triangle[b];
    }
    constexpr double far_m = 0.15; // five times the distance between samples
    return std::min(off_plane_m(scene, samples, a, b), off_plane_m(scene, samples, b, a)) > far_m;
}

constexpr int samples_across = 8; // of a pixel

/// Whether a surface ends between any two samples of a pixel.
bool shows_end(const TriangleScene& scene, const Samples& samples, int x, int y)
{
    const auto width = static_cast<std::size_t>(samples.triangle.size().width_px);
    for (int row = 0; row < samples_across; ++row) {
        for (int column = 0; column < samples_across; ++column) {
            const std::size_t here = static_cast<std::size_t>(y * samples_across + row) * width +
                                     static_cast<std::size_t>(x * samples_across + column);
            if ((column + 1 < samples_across && is_end(scene, samples, here, here + 1)) ||
                (row + 1 < samples_across && is_end(scene, samples, here, here + width))) {
                return true;
            }
        }
    }
    return false;
}

TEST(Silhouettes, AreInEveryPixelInWhichWhatIsSeenEnds)
{
    const TriangleScene scene = solids();
    const ReferenceScene reference{scene};
    int ends = 0;
    int marked = 0;
    for (const View& view : views({48, 36})) {
        View fine = view;
        fine.image = {view.image.width_px * samples_across, view.image.height_px * samples_across};
        Samples samples;
        samples.triangle = first_triangles(reference, fine);
        samples.point = receiver_points(scene, fine, samples.triangle);
        const auto marks = scene::pixels_of_edges(
            scene::silhouette_edges(scene, view.camera), view.camera, 0,
            scene::receiver_near_m(scene.bounds()),
            Image<double>{view.image, std::numeric_limits<double>::infinity()});
        for (int y = 0; y < view.image.height_px; ++y) {
            for (int x = 0; x < view.image.width_px; ++x) {
                marked += marks(x, y);
                if (shows_end(scene, samples, x, y)) {
                    ++ends;
                    ASSERT_EQ(marks(x, y), 1) << "pixel " << x << ", " << y;
                }
            }
        }
    }
    EXPECT_GT(ends, 300);
    EXPECT_LT(marked, 8 * 48 * 36 / 2) << "no more than edges have";
}

} // namespace
} // namespace gnomon::reference_rt::test
