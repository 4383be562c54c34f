#include "scene/light/clipped_range.hpp"

#include "scene/camera/polygon_clip.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

namespace gnomon::scene {
namespace {

/// A linear function of the world, a row of the matrix, with the sum of its absolute terms.
struct Row {
    Vec3d factors;
    double constant = 0;

    [[nodiscard]] double at(const Vec3d& p) const { return glm::dot(factors, p) + constant; }
    [[nodiscard]] double terms_at(const Vec3d& p) const
    {
        return glm::dot(glm::abs(factors), glm::abs(p)) + std::abs(constant);
    }
};

/// The map's sides: a point is inside where W ± X >= 0 and W ± Y >= 0.
///
/// GL evaluates each row in float32 from four products and three sums, in any order: with u = 2^-24
/// it errs by at most 4u/(1 − 4u) of the sum S of the row's absolute terms, X/W and the uv made of
/// it by 2u more. A test that passes in GL passes exactly after adding 8u (S_W + S_X), with 2u of
/// it to spare for this file's arithmetic: its sums in double, and the corners that it clips, err
/// by a few 2^-53 of the same S. S is convex, so a triangle's corners bound it for all of the
/// triangle.
class MapSides {
public:
    explicit MapSides(const Mat4f& light_clip_from_world)
    {
        const Mat4d columns{light_clip_from_world};
        const auto row = [&](int i) {
            return Row{{columns[0][i], columns[1][i], columns[2][i]}, columns[3][i]};
        };
        x_ = row(0);
        y_ = row(1);
        w_ = row(3);
    }

    /// A bit for each side that the point is outside of, by more than the margin at the point. The
    /// margin is convex: where three corners share a bit, all of their triangle is outside.
    [[nodiscard]] std::uint8_t outside(const Vec3d& p) const
    {
        const double x = x_.at(p);
        const double y = y_.at(p);
        const double w = w_.at(p);
        if (std::abs(x) <= w && std::abs(y) <= w) {
            return 0; // as most are: spares the margins
        }
        const Vec2d margin = margins(p);
        const auto bits = int{w + x < -margin.x} | int{w - x < -margin.x} << 1 |
                          int{w + y < -margin.y} << 2 | int{w - y < -margin.y} << 3;
        return static_cast<std::uint8_t>(bits);
    }

    /// The sides, moved outwards by the largest margin of a triangle's corners.
    [[nodiscard]] std::array<HalfSpace, 4> around(std::span<const Vec3d> triangle) const
    {
        Vec2d margin{0};
        for (const Vec3d& corner : triangle) {
            margin = glm::max(margin, margins(corner));
        }
        const auto side = [&](const Row& row, double sign, double moved) {
            return HalfSpace{w_.factors + sign * row.factors,
                             w_.constant + sign * row.constant + moved};
        };
        return {side(x_, 1, margin.x), side(x_, -1, margin.x), side(y_, 1, margin.y),
                side(y_, -1, margin.y)};
    }

private:
    [[nodiscard]] Vec2d margins(const Vec3d& p) const
    {
        constexpr double eight_roundings = 8 * 0x1p-24;
        const double w = w_.terms_at(p);
        return eight_roundings * Vec2d{w + x_.terms_at(p), w + y_.terms_at(p)};
    }

    Row x_;
    Row y_;
    Row w_;
};

/// Which sides each vertex is outside of; includes those that are outside of none.
template <typename Include>
std::vector<std::uint8_t> vertices_outside(const TriangleScene& scene, const MapSides& sides,
                                           const Include& include)
{
    std::vector<std::uint8_t> outside(scene.vertices.size());
    for (std::size_t i = 0; i < outside.size(); ++i) {
        const Vec3d vertex{scene.vertices[i]};
        outside[i] = sides.outside(vertex);
        if (outside[i] == 0) {
            include(vertex); // every vertex is some triangle's corner
        }
    }
    return outside;
}

} // namespace

ClippedRange clipped_range(const LightFrustum& frustum, const TriangleScene& scene)
{
    const Row light_distance{frustum.forward, -glm::dot(frustum.forward, frustum.origin)};
    ClippedRange range;
    const auto include = [&](const Vec3d& point) {
        const double light_distance_m = frustum.light_distance_m(point);
        range.nearest_m = std::min(range.nearest_m, light_distance_m);
        range.farthest_m = std::max(range.farthest_m, light_distance_m);
        range.largest_terms_m = std::max(range.largest_terms_m, light_distance.terms_at(point));
    };
    const MapSides sides{frustum.light_clip_from_world};
    const auto outside = vertices_outside(scene, sides, include);
    if (std::ranges::count(outside, 0) == std::ssize(outside)) {
        return range; // as where the map is fitted to the scene
    }
    PolygonClipper clipper;
    for (const auto& [i, j, k] : scene.triangles) {
        const bool is_inside = (outside[i] | outside[j] | outside[k]) == 0;
        const bool is_outside = (outside[i] & outside[j] & outside[k]) != 0;
        if (is_inside || is_outside) {
            continue;
        }
        const std::array<Vec3d, 3> triangle{Vec3d{scene.vertices[i]}, Vec3d{scene.vertices[j]},
                                            Vec3d{scene.vertices[k]}};
        std::ranges::for_each(clipper.clip(triangle, sides.around(triangle)), include);
    }
    return range;
}

} // namespace gnomon::scene
