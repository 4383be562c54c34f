#pragma once

#include "analysis/renderers.hpp"
#include "scene/image.hpp"
#include "scene/job/job.hpp"
#include "scene/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <span>

namespace gnomon::analysis {

/// What the job's shadow map would hold as d32f, as far as some pixels' lookups read it.
struct FloatMap {
    scene::LookupLayers unbiased; ///< in it, without bias; empty where the job's own says as much
    scene::Image<float> depths;   ///< empty for `linear`, whose lookup interpolates them
};

/// Draws it; the map drawn last is lost.
/// @param lookup  the job's.
[[nodiscard]] FloatMap draw_float_map(const scene::Job& job, const scene::View& view,
                                      const scene::LookupLayers& lookup,
                                      std::span<const std::size_t> pixels,
                                      const Renderers& renderers);

/// The verdicts of the job's method with a d32f map, and 32-bit floats in all that it computes
/// from it.
struct FloatLookups {
    scene::LookupLayers biased; ///< with all of the job's biases
    scene::LookupLayers unbiased;
};

/// Draws and looks it up; the map drawn last is lost.
[[nodiscard]] FloatLookups look_up_floats(const scene::Job& job, const scene::View& view,
                                          const Renderers& renderers);

} // namespace gnomon::analysis
