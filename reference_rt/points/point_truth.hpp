#pragma once

#include "reference_rt/reference_scene.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/given_points.hpp"
#include "scene/vec.hpp"

#include <functional>
#include <span>

namespace gnomon::reference_rt {

/// Barycentric coordinates may be this far outside their triangle: what float32 rounds.
inline constexpr double barycentric_slack = 0x1p-20;

/// How points are worked through.
struct PointOptions {
    int threads = 0; ///< 0: all cores
    /// Called now and then by the calling thread; what it throws ends the work.
    std::function<void()> check_interruption = {};
};

/// Decides for each point on a triangle whether the open segment from it to the light is free
/// (docs/truth.md). Points are independent of each other: their order, their number and the threads
/// change nothing.
/// @param reference  serves exact truth.
/// @param light      its numbers are taken as they are: doubles need not be float32 values.
/// @throws scene::InputError  naming the point, if a triangle is not in the scene or coordinates
/// are
///                            not finite or outside the triangle; or naming a number of the light
///                            that is not 0 and below 1e-28, or beyond 1e15.
/// @throws std::invalid_argument  if there are not as many coordinates as triangles, or if the
///                                reference does not serve exact truth.
[[nodiscard]] scene::PointTruth find_point_truth(const ReferenceScene& reference,
                                                 const scene::Light& light,
                                                 const scene::SurfacePoints& points,
                                                 const PointOptions& options = {});

/// The same of points in space, taken exactly as they are: no triangle is a point's own, so that a
/// point which was rounded below its surface is in that surface's shadow.
/// @throws scene::InputError  likewise, if a coordinate is not finite or beyond 1e15.
[[nodiscard]] scene::PointTruth find_point_truth(const ReferenceScene& reference,
                                                 const scene::Light& light,
                                                 std::span<const scene::Vec3d> points,
                                                 const PointOptions& options = {});

/// Moves points in space to the nearest triangles that receive shadow. The place on the triangle is
/// rounded; that it is on the triangle is not.
/// @throws scene::InputError  likewise.
[[nodiscard]] scene::ProjectedPoints project_points(const ReferenceScene& reference,
                                                    std::span<const scene::Vec3d> points,
                                                    const PointOptions& options = {});

} // namespace gnomon::reference_rt
