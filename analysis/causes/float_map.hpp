#pragma once

#include "renderers/rasterizer.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <memory>
#include <span>

namespace gnomon::analysis {

/// What the job's shadow map would hold as d32f, as far as some pixels' lookups read it.
struct FloatMap {
    scene::LookupLayers unbiased; ///< in it, without bias; empty where the job's own says as much
    scene::Image<float> depths;   ///< empty for `linear`, whose lookup interpolates them
};

/// Draws it.
/// @param lookup     the job's.
/// @param receivers  that are looked up.
[[nodiscard]] FloatMap draw_float_map(const scene::Job& job, const scene::View& view,
                                      const scene::LookupLayers& lookup,
                                      std::span<const std::size_t> pixels,
                                      const std::shared_ptr<const renderers::Receivers>& receivers,
                                      renderers::Rasterizer& rasterizer);

/// The verdicts of the job's method with a d32f map, and 32-bit floats in all that it computes
/// from it.
struct FloatLookups {
    scene::LookupLayers biased; ///< with all of the job's biases
    scene::LookupLayers unbiased;
};

/// Draws it, and looks the receivers up.
[[nodiscard]] FloatLookups
look_up_floats(const scene::Job& job, const scene::View& view,
               const std::shared_ptr<const renderers::Receivers>& receivers,
               renderers::Rasterizer& rasterizer);

} // namespace gnomon::analysis
