#pragma once

#include "scene/pixels/pixel_class.hpp"
#include "scene/pixels/truth.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Points that a caller gives instead of a camera's pixels.
namespace gnomon::scene {

/// The side of a triangle on which a point lies.
enum class PointSide : std::uint8_t {
    to_light, ///< the side that faces the light
    front,    ///< the side that sees the corners counter-clockwise
    back,
};

/// Exact points on triangles: a + u(b − a) + v(c − a) of the triangle (a, b, c). A point's own
/// triangle never blocks it.
struct SurfacePoints {
    std::span<const std::uint32_t> triangles;
    std::span<const Vec2d> barycentrics; ///< (u, v), one per triangle
    PointSide side = PointSide::to_light;
};

/// The truth for points, in order.
struct PointTruth {
    /// `attached`, `out_of_light`, `indeterminate`, `lit` or `blocked`; `attached` only on
    /// triangles.
    std::vector<PixelClass> point_class;
    std::vector<ClassReason> reason;
    std::vector<std::uint32_t> witness; ///< a triangle that blocks; `no_triangle` unless `blocked`
    TruthSigns signs;

    /// The share of the light that a point sees; 0 if it is `attached` or `out_of_light`.
    [[nodiscard]] LightShare share(std::size_t point) const
    {
        const PixelClass of_point = point_class[point];
        const bool is_dark =
            of_point == PixelClass::attached || of_point == PixelClass::out_of_light;
        return is_dark ? LightShare{0, 0} : share_of(of_point);
    }
};

/// Points in space, projected to the nearest points on triangles.
struct ProjectedPoints {
    std::vector<std::uint32_t> triangles; ///< the lowest index among equally near ones
    std::vector<Vec2d> barycentrics;
    std::vector<double> distance_m; ///< by which each was moved
};

} // namespace gnomon::scene
