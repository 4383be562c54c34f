#pragma once

#include "analysis/lookup/lookup_rule.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

namespace gnomon::analysis {

/// The comparison that decides each pixel's verdict: a lookup's samples with `map_depth` replaced
/// by the depth of the deciding tap, NaN where the border mode decides.
///
/// nearest and linear make one comparison: their samples are returned as they came. pcfK makes n =
/// K², or a kernel of n taps as many, and is lit when at least ⌈n/2⌉ are; the critical bias is
/// monotone in the map depth, so the
/// deciding tap is the one of median depth, of two that with which half are lit, where a tap
/// outside the map counts as farther
/// (`outside` lit) or nearer (shadowed) than every depth. Depends on no bias that
/// the curve's formula has.
/// @param where       the same lookup: its texels and maps.
/// @param map_depths  As shaders see them (`scene::maps_image_size`).
///                    Neither is read where there is one comparison.
/// @throws std::invalid_argument  for a filter without a formula; if the images
///                                differ in size; if the maps are not square.
/// Source: raster_gl/shaders/lookup.frag; docs/bias_curve.md#critical-bias.
[[nodiscard]] scene::LookupLayers deciding_samples(scene::LookupLayers lookup,
                                                   const scene::LookupLayers& where,
                                                   const scene::Image<float>& map_depths,
                                                   const LookupRule& rule);

/// True if the lookup without any bias follows from the one with the job's bias: it is at the
/// receiver itself, and each verdict has a deciding tap.
[[nodiscard]] bool can_derive_unbiased(const scene::Job& job, const scene::View& view);

} // namespace gnomon::analysis
