#pragma once

#include "scene/image.hpp"
#include "scene/job.hpp"
#include "scene/layers.hpp"
#include "scene/vec.hpp"

namespace gnomon::analysis {

/// The critical bias of one comparison: the smallest constant bias with which it is lit.
///
///     the smallest b with   fl(r − fl(b + s)) <= d      reversed:   fl(r + fl(b + s)) >= d
///
/// over all biases b: 0 and the normal float32 of either sign. Both subtractions are monotone, so
/// every larger bias is lit too. Subnormal intermediate results are kept, as IEEE 754 says; a
/// driver that flushes them can differ only where |r| < 2^-102.
/// @param r           Receiver depth.
/// @param d           Map depth; NaN is lit with no bias.
/// @param slope_term  s = fl(slope · tan θ).
/// @return  A bias; −∞ if every bias is lit, +∞ if none is.
/// Source: docs/bias_curve.md#critical-bias.
[[nodiscard]] float critical_bias(float r, float d, float slope_term, bool reversed);

/// The part of a job, beside the constant bias, that turns a lookup's samples into verdicts.
struct LookupRule {
    scene::Filter filter = scene::Filter::nearest;
    scene::Outside outside = scene::Outside::lit;
    bool reversed = false;
    float slope = 0; ///< depth units per unit of tan θ
};
/// The rule of a job and the view that it was resolved to.
[[nodiscard]] LookupRule lookup_rule(const scene::Job& job, const scene::View& view);

/// The comparison that decides each pixel's verdict: a lookup's samples with `map_depth` replaced
/// by the depth of the deciding tap, NaN where the policy for texels outside decides.
///
/// nearest and linear make one comparison: their samples are returned as they came. pcfK makes K ×
/// K and is lit when at least ⌈K²/2⌉ are; the critical bias is monotone in the map depth, so the
/// deciding tap is the one of median depth, where a tap outside the map counts as farther
/// (`outside` lit) or nearer (shadowed) than every depth. Depends on no bias but a normal offset.
/// @param texels      uv · resolution of each lookup, origin at the map's lower left.
/// @param map_depths  The map's depths as shaders see them, top left first, square.
///                    Neither is read unless the filter is pcfK.
/// @throws std::invalid_argument  for `hardware`, whose weights are the driver's own; if the images
///                                differ in size; if the map is not square.
/// Source: raster_gl/shaders/lookup.frag; docs/bias_curve.md#critical-bias.
[[nodiscard]] scene::LookupLayers deciding_samples(scene::LookupLayers lookup,
                                                   const scene::Image<scene::Vec2f>& texels,
                                                   const scene::Image<float>& map_depths,
                                                   const LookupRule& rule);

/// True if the lookup without any bias follows from the one with the job's bias: it is at the
/// receiver itself, and each verdict has a deciding tap.
[[nodiscard]] bool can_derive_unbiased(const scene::Job& job, const scene::View& view);

/// Makes each verdict the one with this constant bias: 1 or 0, that of the majority of its taps.
/// @param criticals  The lookup's `critical_biases`.
void set_verdicts(scene::LookupLayers& lookup, const scene::Image<float>& criticals, float bias);

/// Critical biases that say nothing but the lookup's own verdicts: −∞ where it is lit, else +∞.
[[nodiscard]] scene::Image<float> criticals_of_verdicts(const scene::LookupLayers& lookup);

/// The critical bias of each pixel.
/// @param lookup  Of a nearest or linear lookup, or from `deciding_samples`. Where `map_depth` is
///                NaN the policy decides: −∞ for `outside` lit, +∞ for shadowed. Pixels without a
///                receiver, all zero, get 0.
[[nodiscard]] scene::Image<float> critical_biases(const scene::LookupLayers& lookup,
                                                  const LookupRule& rule);

} // namespace gnomon::analysis
