#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <limits>
#include <optional>

namespace gnomon::scene {

/// "Any object": the pixel's object is unknown.
inline constexpr std::uint32_t no_object = 0xFFFFFFFF;

/// The points that another renderer's pixels show. All images have one size.
struct RoundedReceivers {
    Image<Vec3f> position; ///< P, rounded to float32 [m]; not finite where a pixel shows nothing
    /// Empty, or the geometric normal on the visible side, of any length; zero or not finite if
    /// unknown.
    Image<Vec3f> normal = {};
    std::optional<Vec3d> eye{}; ///< of a perspective camera, float32-representable [m]
    /// Empty, or index into `TriangleScene::objects`; `no_object` if unknown.
    Image<std::uint32_t> object = {};
    /// Largest distance of P from its surface [m]; nothing is decided for points farther away.
    double most_distance_m = std::numeric_limits<double>::infinity();
};

/// The truth for rounded receivers: for each, what holds for every point that may round to P.
struct RoundedTruth {
    /// `background` if P is not finite; `attached` only if the visible side is known;
    /// `indeterminate` by `rounding` if the truth may differ between these points.
    Truth truth;
    Image<std::uint32_t> triangle; ///< T, nearest to P; the lowest index among equally near ones
    Image<float> distance_m;       ///< from P to T [m]
    /// Growth of P's rounding box on each side that makes it meet the plane of T; usually 0.
    /// Infinite if P is too far from every surface in its scope; then the pixel is `indeterminate`,
    /// and T is the nearest triangle of any object.
    Image<float> growth_m;
};

/// The triangles to search.
struct SurfaceScope {
    std::uint32_t object = no_object; ///< index; `no_object`: all receiving objects
    /// The search ends at this distance [m].
    double most_distance_m = std::numeric_limits<double>::infinity();
};

/// The surface nearest to a point.
struct NearestSurface {
    std::uint32_t triangle = no_triangle;
    double distance_m = std::numeric_limits<double>::infinity();
};

} // namespace gnomon::scene
