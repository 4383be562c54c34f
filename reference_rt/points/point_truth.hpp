#pragma once

#include "reference_rt/reference_scene.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/given_points.hpp"
#include "scene/vec.hpp"

#include <functional>
#include <span>

namespace gnomon::reference_rt {

/// How far barycentric coordinates may lie outside their triangle, to allow for float32 rounding.
inline constexpr double barycentric_slack = 0x1p-20;

/// Options of point queries.
struct PointOptions {
    int threads = 0; ///< 0 for all cores
    /// Called now and then on the calling thread; an exception from it ends the work.
    std::function<void()> check_interruption = {};
};

/// Decides for each point on a triangle whether the open segment to the light is free
/// (docs/truth.md). The answer for a point does not depend on other points or on the number of
/// threads.
/// @param reference  serves exact truth.
/// @param light      taken exactly as given; doubles need not be float32 values.
/// @throws scene::InputError  naming the point, if its triangle is not in the scene or its
///                            coordinates are not finite or outside the triangle; or naming a
///                            number of the light whose size is beyond 1e15, or below 1e-28 but not
///                            0.
/// @throws std::invalid_argument  if the numbers of coordinates and triangles differ, or if the
///                                reference does not serve exact truth.
[[nodiscard]] scene::PointTruth find_point_truth(const ReferenceScene& reference,
                                                 const scene::Light& light,
                                                 const scene::SurfacePoints& points,
                                                 const PointOptions& options = {});

/// Decides points in space, taken exactly as given. No triangle is a point's own, so a point
/// rounded to below its surface is in that surface's shadow.
/// @throws scene::InputError  as above, if a coordinate is not finite or beyond 1e15.
[[nodiscard]] scene::PointTruth find_point_truth(const ReferenceScene& reference,
                                                 const scene::Light& light,
                                                 std::span<const scene::Vec3d> points,
                                                 const PointOptions& options = {});

/// Projects points in space onto the nearest receiving triangles. Barycentric coordinates are
/// rounded, so a projected point is exactly on its triangle.
/// @throws scene::InputError  as above.
[[nodiscard]] scene::ProjectedPoints project_points(const ReferenceScene& reference,
                                                    std::span<const scene::Vec3d> points,
                                                    const PointOptions& options = {});

} // namespace gnomon::reference_rt
