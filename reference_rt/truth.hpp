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

/// Decides the class of every pixel (docs/truth.md) for GL's triangle in each.
///
/// Independent of every shadow-map setting. Deterministic for any number of threads. Source:
/// docs/truth.md.
/// @param receivers  GL's triangle per pixel, of size `view.image`.
/// @throws std::invalid_argument  if sizes differ, an index is out of range, or `reference` does
///                                not serve the method.
[[nodiscard]] scene::Truth compute_truth(const ReferenceScene& reference, const scene::View& view,
                                         const scene::Image<std::uint32_t>& receivers,
                                         const renderers::RasterFacts& raster,
                                         const TruthOptions& options = {});

/// The exact blocker nearest to the light of each given pixel: the triangle that the open segment
/// P→light crosses properly, or through a seam (of whose two the lower index counts), nearest to
/// the light; of several at the same point the lowest index. `no_triangle` where nothing blocks.
///
/// @param pixels     row-major pixel indices; GL's triangle in each must be a first hit of its ray.
/// @param receivers  GL's triangle per pixel, of size `view.image`.
/// @return  In the order of the pixels.
/// @throws std::invalid_argument  as `compute_truth` does, or if a pixel has no receiver.
[[nodiscard]] std::vector<std::uint32_t>
nearest_blockers(const ReferenceScene& reference, const scene::View& view,
                 const scene::Image<std::uint32_t>& receivers, std::span<const std::size_t> pixels,
                 int threads = 0);

/// How many scored pixels each of the usual float methods would have got wrong: shadow rays from P
/// rounded to float32, kept off their own surface in one way or another.
/// @return  Always the same four methods, in the same order.
/// @throws std::invalid_argument  if sizes differ or `reference` does not serve plain rays.
[[nodiscard]] std::vector<scene::FloatMethodErrors>
audit_float_methods(const ReferenceScene& reference, const scene::View& view,
                    const scene::Image<std::uint32_t>& receivers, const scene::Truth& truth,
                    int threads = 0);

/// The triangle that each pixel-centre ray meets first beyond the near plane, decided exactly; of
/// several at one point the lowest index; `no_triangle` where there is none.
[[nodiscard]] scene::Image<std::uint32_t> first_triangles(const ReferenceScene& reference,
                                                          const scene::View& view, int threads = 0);

/// P of each pixel, the pixel-centre ray ∩ plane(T), computed in double and rounded to float32;
/// NaN where there is no receiver.
[[nodiscard]] scene::Image<scene::Vec3f>
receiver_points(const scene::TriangleScene& triangles, const scene::View& view,
                const scene::Image<std::uint32_t>& receivers);

/// "Embree 3.13.5", for the environment record.
[[nodiscard]] std::string embree_version();

} // namespace gnomon::reference_rt
