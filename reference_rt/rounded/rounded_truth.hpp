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

/// Decides the class of every pixel (docs/truth.md) whose point is known by its rounded position
/// only.
///
/// T is the receiving triangle nearest to P, of the pixel's object where that is known; P may have
/// been every point of the plane of T in the box of all that round to P. The box is grown by the
/// same length on each side until it meets the plane. A class is given where it is shown to hold
/// for all of these points, and for each T where several are nearest; none where P is farther from
/// its surface than `most_distance_m`. Deterministic for any number of threads. Source:
/// docs/evaluate.md.
/// @param reference  serves exact truth.
/// @throws std::invalid_argument  if images differ in size, or an object is out of range.
[[nodiscard]] scene::RoundedTruth compute_rounded_truth(const ReferenceScene& reference,
                                                        const scene::Light& light,
                                                        const scene::RoundedReceivers& receivers,
                                                        int threads = 0);

/// The triangle of its scope nearest to each point, in double precision; for finding out what is
/// wrong with points that are on no surface.
/// @param scopes  one for each point; empty: all that receive.
/// @return  In the order of the points; `no_triangle` where the point is not finite or its scope
///          holds none.
[[nodiscard]] std::vector<scene::NearestSurface>
nearest_surfaces(const ReferenceScene& reference, std::span<const scene::Vec3d> points,
                 std::span<const scene::SurfaceScope> scopes = {}, int threads = 0);

/// The blocker nearest to the light of blocked pixels, for the point of T nearest to P.
/// @param pixels  row-major indices, `blocked` in `truth`.
/// @return  In the order of the pixels; `no_triangle` where none is found. Light distances are not
///          known: NaN for every blocker found.
[[nodiscard]] std::vector<renderers::BlockerHit>
find_rounded_blockers(const ReferenceScene& reference, const scene::Light& light,
                      const scene::RoundedReceivers& receivers, const scene::RoundedTruth& truth,
                      std::span<const std::size_t> pixels, int threads = 0);

} // namespace gnomon::reference_rt
