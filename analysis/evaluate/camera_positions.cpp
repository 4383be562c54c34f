#include "analysis/evaluate/camera_positions.hpp"

#include "scene/infinity.hpp"
#include "scene/view/silhouettes.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gnomon::analysis {

namespace {

using scene::Image;
using scene::Vec3d;
using scene::Vec3f;

/// Along the camera's axis [m]; infinite where nothing is seen.
Image<double> distances_of(const scene::Camera& camera, const Image<Vec3f>& points)
{
    Image<double> distances{points.size(), scene::infinity};
    for (std::size_t i = 0; i < points.pixel_count(); ++i) {
        if (!std::isnan(points[i].x)) {
            distances[i] = glm::dot(Vec3d{points[i]} - camera.eye, camera.forward);
        }
    }
    return distances;
}

/// The largest of each pixel and its neighbours, and a little more, for P is rounded.
Image<double> farthest_around(const Image<double>& distances)
{
    constexpr double rounding = 1 + 0x1p-16;
    const auto [width, height] = distances.size();
    Image<double> farthest{distances.size(), 0};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row) {
                for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1);
                     ++column) {
                    farthest(x, y) = std::max(farthest(x, y), distances(column, row) * rounding);
                }
            }
        }
    }
    return farthest;
}

} // namespace

void take_camera_positions(scene::CaseLayers& layers, const scene::TriangleScene& mesh,
                           const scene::View& view, const Image<Vec3f>& points, bool is_mirrored)
{
    const Image<std::uint8_t> shows_silhouette = scene::pixels_of_edges(
        scene::silhouette_edges(mesh, view.camera), view.camera, silhouette_margin_px,
        scene::receiver_near_m(mesh.bounds()), farthest_around(distances_of(view.camera, points)));
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    const auto [width, height] = view.image;
    std::uint64_t set_aside = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int column = is_mirrored ? width - 1 - x : x;
            if (std::isnan(layers.position(x, y).x)) {
                continue;
            }
            const bool is_set_aside = shows_silhouette(column, y) != 0;
            set_aside += is_set_aside ? 1U : 0U;
            layers.position(x, y) = is_set_aside ? Vec3f{nothing} : points(column, y);
        }
    }
    layers.silhouette_pixels = set_aside;
}

} // namespace gnomon::analysis
