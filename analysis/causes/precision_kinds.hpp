#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/causes/cause_inputs.hpp"
#include "renderers/rasterizer.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The job's shadow map as d32f, as far as the lookups of some pixels read it.
struct FloatMap {
    scene::LookupLayers unbiased; ///< the unbiased lookup in it; empty if the job's own serves
    scene::Image<float> depths;   ///< empty for `linear`, whose lookup interpolates them
};

/// Draws the job's map as d32f.
/// @param lookup     The job's.
/// @param receivers  The receivers to look up.
[[nodiscard]] FloatMap draw_float_map(const scene::Job& job, const scene::View& view,
                                      const scene::LookupLayers& lookup,
                                      std::span<const std::size_t> pixels,
                                      const std::shared_ptr<const renderers::Receivers>& receivers,
                                      renderers::Rasterizer& rasterizer);

/// Verdicts of the job's method with a d32f map and float32 in all filtered data.
struct FloatLookups {
    scene::LookupLayers biased; ///< with all of the job's biases
    scene::LookupLayers unbiased;
};

/// Draws a d32f map and looks up the receivers.
[[nodiscard]] FloatLookups
look_up_floats(const scene::Job& job, const scene::View& view,
               const std::shared_ptr<const renderers::Receivers>& receivers,
               renderers::Rasterizer& rasterizer);

/// Wrong pixels of cause `precision`, by its origin (docs/causes.md).
struct PrecisionKinds {
    std::uint64_t format = 0;    ///< right with the same map as float32
    std::uint64_t transform = 0; ///< caused by float32 matrices and interpolated positions
};

/// The wrong pixels of cause `precision`: row-major indices, ascending.
[[nodiscard]] std::vector<std::size_t> wrong_by_precision(const scene::Image<Cause>& causes,
                                                          const scene::Truth& truth,
                                                          const scene::LookupLayers& lookup);

/// Counts the pixels by whether the same map as d32f repairs them, compared as in V1 with V2's
/// bias.
/// @param floats  From that map: its `job` has the job's tan θ; its `unbiased` and `map_depths` are
///                the float map's (`linear`: no `map_depths`).
/// @param pixels  From `wrong_by_precision`.
/// @param bias    The job's.
[[nodiscard]] PrecisionKinds find_precision_kinds(const CauseInputs& floats,
                                                  std::span<const std::size_t> pixels,
                                                  const scene::Bias& bias);

/// Counts the pixels for a method that does not compare depths.
/// @param biased, unbiased  Its verdicts in the d32f map, with the job's biases and without.
[[nodiscard]] PrecisionKinds find_precision_kinds(const scene::Truth& truth,
                                                  const scene::LookupLayers& biased,
                                                  const scene::LookupLayers& unbiased,
                                                  std::span<const std::size_t> pixels);

} // namespace gnomon::analysis
