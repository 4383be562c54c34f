#pragma once

#include "reference_rt/truth.hpp"
#include "renderers/light_queries.hpp"
#include "scene/pixels/rounded_receivers.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::reference_rt {

/// Classifies every pixel (docs/truth.md) whose point is known only by its rounded position.
///
/// T is the receiving triangle nearest to P, within the pixel's object if known. P may stand for
/// any point of T's plane in the box of points that round to P; the box grows equally on each side
/// until it meets the plane. A pixel gets a class only if it is proven for all these points, and
/// for each T if several are nearest. It gets none if P is farther from its surface than
/// `most_distance_m`. Deterministic for any number of threads. Source: docs/evaluate.md.
/// @param reference  serves exact truth.
/// @throws std::invalid_argument  if images differ in size, or an object is out of range.
[[nodiscard]] scene::RoundedTruth compute_rounded_truth(const ReferenceScene& reference,
                                                        const scene::Light& light,
                                                        const scene::RoundedReceivers& receivers,
                                                        int threads = 0);

/// The nearest triangle in each point's scope, in double precision; used to diagnose points that
/// are not on any surface.
/// @param scopes  one for each point; empty for all receiving triangles.
/// @return  One surface for each point; `no_triangle` if the point is not finite or its scope is
///          empty.
[[nodiscard]] std::vector<scene::NearestSurface>
nearest_surfaces(const ReferenceScene& reference, std::span<const scene::Vec3d> points,
                 std::span<const scene::SurfaceScope> scopes = {}, int threads = 0);

/// The blocker nearest to the light for each blocked pixel, from the point of T nearest to P.
/// @param pixels  row-major indices, `blocked` in `truth`.
/// @return  One blocker for each pixel; `no_triangle` if none is found. Light distances are
///          unknown, so they are NaN.
[[nodiscard]] std::vector<renderers::BlockerHit>
find_rounded_blockers(const ReferenceScene& reference, const scene::Light& light,
                      const scene::RoundedReceivers& receivers, const scene::RoundedTruth& truth,
                      std::span<const std::size_t> pixels, int threads = 0);

} // namespace gnomon::reference_rt
