#include "analysis/evaluate/evaluate.hpp"

#include "scene/camera/silhouettes.hpp"
#include "scene/error.hpp"
#include "scene/infinity.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::analysis {

namespace {

using scene::Image;
using scene::Vec3d;
using scene::Vec3f;

/// Each pixel's square is grown by this much on each side before the search for silhouettes [px]:
/// twice the step of a rasteriser's grid, which has at least 4 bits in GL, Direct3D and Vulkan.
constexpr double silhouette_margin_px = 0x1p-4;

/// Distances along the camera's axis [m]; infinite where nothing is seen.
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

/// The largest distance of each pixel and its neighbours, and a little more, for P is rounded.
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

/// Counts of pixels.
struct Judged {
    std::uint64_t asked = 0; ///< that the case wants judged
    std::uint64_t shown = 0; ///< those of them where the camera sees something
    std::uint64_t set_aside = 0;
};

void require_some(const Judged& count)
{
    if (count.asked == 0) {
        throw scene::InputError("no pixel is to be judged: valid is 0 or the mask NaN everywhere");
    }
    if (count.shown == 0) {
        throw scene::InputError("no pixel is to be judged: the camera does not see the mesh there; "
                                "check camera.eye, camera.target, camera.up and the units");
    }
    if (count.shown == count.set_aside) {
        throw scene::InputError(
            fmt::format("no pixel is to be judged: a silhouette may cross each of "
                        "the {} that show something; write P, or a larger image",
                        count.shown));
    }
}

} // namespace

void take_camera_positions(scene::CaseLayers& layers, const scene::TriangleScene& mesh,
                           const scene::View& view, const Image<Vec3f>& points, bool is_mirrored)
{
    const Image<std::uint8_t> shows_silhouette = scene::pixels_of_edges(
        scene::silhouette_edges(mesh, view.camera), view.camera, silhouette_margin_px,
        scene::receiver_near_m(mesh.bounds()), farthest_around(distances_of(view.camera, points)));
    const auto [width, height] = view.image;
    layers.is_asked = Image<std::uint8_t>{view.image};
    Judged count;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int column = is_mirrored ? width - 1 - x : x;
            const Vec3f& shown = points(column, y);
            if (std::isnan(layers.position(x, y).x)) {
                continue;
            }
            ++count.asked;
            layers.is_asked(x, y) = 1;
            count.shown += std::isnan(shown.x) ? 0U : 1U;
            const bool is_set_aside = !std::isnan(shown.x) && shows_silhouette(column, y) != 0;
            count.set_aside += is_set_aside ? 1U : 0U;
            layers.position(x, y) =
                is_set_aside ? Vec3f{std::numeric_limits<float>::quiet_NaN()} : shown;
        }
    }
    require_some(count);
    layers.silhouette_pixels = count.set_aside;
}

} // namespace gnomon::analysis
