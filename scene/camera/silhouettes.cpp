#include "scene/camera/silhouettes.hpp"

#include "scene/geometry/surfaces.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace gnomon::scene {

namespace {

/// The side of the plane through eye and edge on which a point lies: 1, −1, or 0 if double cannot
/// decide.
int side_of(const Camera& camera, const Edge& edge, const Vec3d& point)
{
    const Vec3d along = edge[1] - edge[0];
    const Vec3d sight =
        camera.projection == Projection::perspective ? edge[0] - camera.eye : camera.forward;
    const Vec3d to_point = point - edge[0];
    const double side = glm::dot(glm::cross(along, sight), to_point);
    // Differences are rounded once, and products of three of them a few times more.
    const double size = glm::length(along) * glm::length(sight) * glm::length(to_point);
    return std::abs(side) <= 0x1p-48 * size ? 0 : (side > 0 ? 1 : -1);
}

/// A segment in the image, with a depth that is linear there.
struct ImageEdge {
    std::array<Vec2d, 2> ends_px; ///< (0, 0) at the image's upper left corner
    std::array<double, 2> depth;  ///< perspective: 1/ζ [1/m]; orthographic: ζ [m]
};

class EdgeDrawing {
public:
    EdgeDrawing(const Camera& camera, double margin_px, double near_m,
                const Image<double>& farthest_m)
        : camera_{camera},
          margin_px_{margin_px},
          near_m_{near_m},
          farthest_m_{farthest_m},
          marks_{farthest_m.size(), 0}
    {
    }

    void draw(const Edge& edge)
    {
        const auto seen = in_front(edge);
        if (!seen) {
            return;
        }
        const ImageEdge image{{window(seen->at(0)), window(seen->at(1))},
                              {depth(seen->at(0).z), depth(seen->at(1).z)}};
        const auto [low, high] = std::minmax(image.ends_px[0].y, image.ends_px[1].y);
        const auto [first, last] = range(low, high, marks_.size().height_px);
        for (int y = first; y <= last; ++y) {
            draw_row(image, y);
        }
    }

    [[nodiscard]] const Image<std::uint8_t>& marks() const { return marks_; }

private:
    /// A share of the segment, [begin, end] within [0, 1].
    using Share = std::pair<double, double>;

    /// The part beyond the near plane, in the camera's axes.
    [[nodiscard]] std::optional<Edge> in_front(const Edge& edge) const
    {
        Edge ends;
        for (std::size_t i = 0; i < 2; ++i) {
            const Vec3d from_eye = edge[i] - camera_.eye;
            ends[i] = {glm::dot(from_eye, camera_.right), glm::dot(from_eye, camera_.up),
                       glm::dot(from_eye, camera_.forward)};
        }
        if (std::max(ends[0].z, ends[1].z) <= near_m_) {
            return std::nullopt;
        }
        for (std::size_t i = 0; i < 2; ++i) {
            if (ends[i].z < near_m_) {
                const double t = (near_m_ - ends[i].z) / (ends[1 - i].z - ends[i].z);
                ends[i] += t * (ends[1 - i] - ends[i]);
                ends[i].z = near_m_;
            }
        }
        return ends;
    }

    [[nodiscard]] Vec2d window(const Vec3d& point) const
    {
        const double scale = camera_.projection == Projection::perspective ? point.z : 1.0;
        const double half_height_px = 0.5 * marks_.size().height_px;
        const double px_per_unit = half_height_px / camera_.half_height;
        return {0.5 * marks_.size().width_px + point.x / scale * px_per_unit,
                half_height_px - point.y / scale * px_per_unit};
    }
    [[nodiscard]] double depth(double zeta_m) const
    {
        return camera_.projection == Projection::perspective ? 1.0 / zeta_m : zeta_m;
    }
    [[nodiscard]] double zeta_m(const ImageEdge& edge, double t) const
    {
        const double at = edge.depth[0] + t * (edge.depth[1] - edge.depth[0]);
        return camera_.projection == Projection::perspective ? 1.0 / at : at;
    }

    /// The rows or columns whose grown squares meet [low, high].
    [[nodiscard]] std::pair<int, int> range(double low, double high, int count) const
    {
        const double first = std::floor(std::clamp(low - margin_px_, 0.0, double(count)));
        const double last = std::floor(std::clamp(high + margin_px_, -1.0, double(count - 1)));
        return {static_cast<int>(first), static_cast<int>(last)};
    }

    /// The share of [begin, end] in which the coordinate from a to b is in the grown square of
    /// `index`.
    [[nodiscard]] Share share_within(double a, double b, int index, Share within) const
    {
        const double low = index - margin_px_;
        const double high = index + 1 + margin_px_;
        if (a == b) {
            return low <= a && a <= high ? within : Share{1, 0};
        }
        const auto [enter, leave] = std::minmax({(low - a) / (b - a), (high - a) / (b - a)});
        return {std::max(within.first, enter), std::min(within.second, leave)};
    }

    void draw_row(const ImageEdge& edge, int y)
    {
        const auto& [from, to] = edge.ends_px;
        const Share row = share_within(from.y, to.y, y, {0, 1});
        if (row.first > row.second) {
            return;
        }
        const auto [low, high] = std::minmax(
            {from.x + row.first * (to.x - from.x), from.x + row.second * (to.x - from.x)});
        const auto [first, last] = range(low, high, marks_.size().width_px);
        for (int x = first; x <= last; ++x) {
            const auto [begin, end] = share_within(from.x, to.x, x, row);
            if (begin <= end &&
                std::min(zeta_m(edge, begin), zeta_m(edge, end)) <= farthest_m_(x, y)) {
                marks_(x, y) = 1;
            }
        }
    }

    const Camera& camera_;
    double margin_px_;
    double near_m_;
    const Image<double>& farthest_m_;
    Image<std::uint8_t> marks_;
};

} // namespace

std::vector<Edge> silhouette_edges(const TriangleScene& scene, const Camera& camera)
{
    const std::vector<EdgeOfTriangle> all = receiving_edges(scene);
    std::vector<Edge> silhouettes;
    for (std::size_t begin = 0; begin < all.size();) {
        std::size_t end = begin + 1;
        while (end < all.size() && all[end].a == all[begin].a && all[end].b == all[begin].b) {
            ++end;
        }
        const Edge edge{Vec3d{scene.vertices[all[begin].a]}, Vec3d{scene.vertices[all[begin].b]}};
        const auto side = [&](std::size_t i) {
            return side_of(camera, edge, Vec3d{scene.vertices[all[i].opposite]});
        };
        if (end - begin != 2 || side(begin) * side(begin + 1) != -1) {
            silhouettes.push_back(edge);
        }
        begin = end;
    }
    return silhouettes;
}

Image<std::uint8_t> pixels_of_edges(std::span<const Edge> edges, const Camera& camera,
                                    double margin_px, double near_m,
                                    const Image<double>& farthest_m)
{
    EdgeDrawing drawing{camera, margin_px, near_m, farthest_m};
    for (const Edge& edge : edges) {
        drawing.draw(edge);
    }
    return drawing.marks();
}

} // namespace gnomon::scene
