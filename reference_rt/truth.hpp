#pragma once

#include "reference_rt/reference_scene.hpp"
#include "renderers/values.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::reference_rt {

/// Classifies every pixel (docs/truth.md), for GL's triangle in each.
///
/// Independent of all shadow-map settings. Deterministic for any number of threads. Source:
/// docs/truth.md.
/// @param receivers  GL's triangle per pixel, of size `view.image`.
/// @throws std::invalid_argument  if sizes differ, an index is out of range, or `reference` does
///                                not serve the method.
[[nodiscard]] scene::Truth compute_truth(const ReferenceScene& reference, const scene::View& view,
                                         const scene::Image<std::uint32_t>& receivers,
                                         const renderers::RasterFacts& raster,
                                         const TruthOptions& options = {});

/// The exact blocker of each given pixel: the triangle nearest to the light that the open segment
/// P→light crosses properly or through a seam (which counts as its lower index). Ties go to the
/// lowest index. `no_triangle` if nothing blocks.
///
/// @param pixels     row-major indices; GL's triangle in each must be a first hit of its ray.
/// @param receivers  GL's triangle per pixel, of size `view.image`.
/// @return  One entry for each pixel.
/// @throws std::invalid_argument  as `compute_truth`, or if a pixel has no receiver.
[[nodiscard]] std::vector<std::uint32_t>
nearest_blockers(const ReferenceScene& reference, const scene::View& view,
                 const scene::Image<std::uint32_t>& receivers, std::span<const std::size_t> pixels,
                 int threads = 0);

/// Counts the scored pixels that each common float method gets wrong: shadow rays from P rounded to
/// float32, with different self-intersection offsets.
/// @return  Always the same four methods, in the same order.
/// @throws std::invalid_argument  if sizes differ or `reference` does not serve plain rays.
[[nodiscard]] std::vector<scene::FloatMethodErrors>
audit_float_methods(const ReferenceScene& reference, const scene::View& view,
                    const scene::Image<std::uint32_t>& receivers, const scene::Truth& truth,
                    int threads = 0);

/// The triangle that each pixel-centre ray meets first beyond the near plane, decided exactly. Ties
/// go to the lowest index; `no_triangle` without a hit.
[[nodiscard]] scene::Image<std::uint32_t> first_triangles(const ReferenceScene& reference,
                                                          const scene::View& view, int threads = 0);

/// P of each pixel: pixel-centre ray ∩ plane(T), computed in double and rounded to float32; NaN
/// without a receiver.
[[nodiscard]] scene::Image<scene::Vec3f>
receiver_points(const scene::TriangleScene& triangles, const scene::View& view,
                const scene::Image<std::uint32_t>& receivers);

/// For example "Embree 3.13.5", for the environment record.
[[nodiscard]] std::string embree_version();

} // namespace gnomon::reference_rt
