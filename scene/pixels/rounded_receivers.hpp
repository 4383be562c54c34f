#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <limits>
#include <optional>

namespace gnomon::scene {

/// "Any object": where a pixel's object is not known.
inline constexpr std::uint32_t no_object = 0xFFFFFFFF;

/// What another renderer says of the points that its pixels show. All images are of one size.
struct RoundedReceivers {
    Image<Vec3f> position; ///< P, rounded to float32 [m]; not finite where a pixel shows nothing
    /// Empty, or the geometric normal on the side that is seen, of any length; zero or not finite
    /// where it is not known.
    Image<Vec3f> normal = {};
    std::optional<Vec3d> eye{}; ///< of a perspective camera, float32-representable [m]
    /// Empty, or index into `TriangleScene::objects`; `no_object` where it is not known.
    Image<std::uint32_t> object = {};
    /// How far P may be from its surface [m]; farther away nothing is decided, however large a box
    /// would be.
    double most_distance_m = std::numeric_limits<double>::infinity();
};

/// What is true of rounded receivers: of each, what holds for every point that P may have been.
struct RoundedTruth {
    /// `background` where P is not finite; `attached` only where the side that is seen is known;
    /// `indeterminate` by `rounding` where the truth is not shown to be the same for all points.
    Truth truth;
    Image<std::uint32_t> triangle; ///< T, nearest to P; of several the lowest index
    Image<float> distance_m;       ///< from P to T [m]
    /// By how much P's rounding box was grown on each side to meet the plane of T; 0 as a rule,
    /// infinite where P is too far from every surface of its scope: `indeterminate`, with the
    /// nearest triangle of any object for T.
    Image<float> growth_m;
};

/// Which triangles count in a search.
struct SurfaceScope {
    std::uint32_t object = no_object; ///< index; `no_object`: all that receive
    /// Triangles farther away need not be found [m]: the search ends there.
    double most_distance_m = std::numeric_limits<double>::infinity();
};

/// The surface nearest to a point.
struct NearestSurface {
    std::uint32_t triangle = no_triangle;
    double distance_m = std::numeric_limits<double>::infinity();
};

} // namespace gnomon::scene
