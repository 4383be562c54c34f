#pragma once

#include "scene/pixels/pixel_class.hpp"
#include "scene/pixels/truth.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Points that a caller gives, in place of the pixels of a camera.
namespace gnomon::scene {

/// The side of a triangle on which a point is.
enum class PointSide : std::uint8_t {
    to_light, ///< the one that faces the light
    front,    ///< the one that sees the corners counter-clockwise
    back,
};

/// Points on triangles, exactly: a + u(b − a) + v(c − a) of the triangle (a, b, c). Its own
/// triangle never blocks a point.
struct SurfacePoints {
    std::span<const std::uint32_t> triangles;
    std::span<const Vec2d> barycentrics; ///< (u, v); as many
    PointSide side = PointSide::to_light;
};

/// What is true of points, in their order.
struct PointTruth {
    /// `attached`, `out_of_light`, `indeterminate`, `lit` or `blocked`; `attached` only on
    /// triangles.
    std::vector<PixelClass> point_class;
    std::vector<ClassReason> reason;
    std::vector<std::uint32_t> witness; ///< a triangle that blocks; `no_triangle` unless `blocked`
    TruthSigns signs;

    /// The share of the light that a point sees; nothing of a point that is `attached` or
    /// `out_of_light`.
    [[nodiscard]] LightShare share(std::size_t point) const
    {
        const PixelClass of_point = point_class[point];
        const bool is_dark =
            of_point == PixelClass::attached || of_point == PixelClass::out_of_light;
        return is_dark ? LightShare{0, 0} : share_of(of_point);
    }
};

/// Where points in space were moved to: the nearest points on triangles.
struct ProjectedPoints {
    std::vector<std::uint32_t> triangles; ///< of several at the same distance the lowest
    std::vector<Vec2d> barycentrics;
    std::vector<double> distance_m; ///< by which each was moved
};

} // namespace gnomon::scene
