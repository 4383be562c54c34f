#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/exact_lookup.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Traces the lookups of pixels.
/// @param layers  Where they read: the inputs' `job` or `unbiased`.
[[nodiscard]] TracedLookups trace_lookups(const CauseInputs& inputs,
                                          const scene::LookupLayers& layers,
                                          std::span<const std::size_t> pixels);

/// Traces the lookups of pixels.
/// @param points  Where they read, in the order of the pixels.
[[nodiscard]] TracedLookups trace_lookups(const CauseInputs& inputs,
                                          std::vector<scene::MapPoint> points,
                                          std::span<const std::size_t> pixels);

/// The taps of each lookup that shadow without bias, judged by the stored depths.
[[nodiscard]] std::vector<TapSet> shadowing_taps(const CauseInputs& inputs,
                                                 const scene::LookupLayers& layers,
                                                 const TracedLookups& lookups);

/// The taps of each lookup whose texels see the receiver's self-shadowing surface (docs/causes.md).
/// @param asked  The taps to test, by lookup.
[[nodiscard]] std::vector<TapSet> own_taps(const renderers::LightQueries& light,
                                           const TracedLookups& lookups,
                                           std::span<const TapSet> asked);

/// V2 of each lookup of a method that was run over exact depths.
[[nodiscard]] std::vector<float> rerun_biases(const ExactReruns& reruns,
                                              const TracedLookups& lookups, LitShare share);

/// Lookups that float32 displaces: at the exact uv · resolution they would read other taps than GL.
/// This happens far from the origin.
struct DisplacedLookups {
    std::vector<std::size_t> indices; ///< among the given pixels
    std::vector<std::size_t> pixels;
    std::vector<scene::MapPoint> points; ///< the exact positions of those
    std::vector<std::size_t> of_border;  ///< indices of other pixels, at whose exact position the
                                         ///< border mode decides all taps
};

/// Finds the displaced lookups among the pixels.
/// @param layers  GL's lookup.
/// @param moved   Its `ReceiverRule::moved`; null: it reads at the receivers themselves.
[[nodiscard]] DisplacedLookups find_displaced(const CauseInputs& inputs,
                                              const scene::LookupLayers& layers,
                                              std::span<const std::size_t> pixels,
                                              const scene::Image<scene::Vec4f>* moved);

/// V2 of a lookup that compares triangles: lit iff the texel's ray first hits the receiver's own
/// triangle, at any bias. Without a texel, the border mode decides.
/// @param receivers  The triangle that each pixel shows.
/// @return  −∞ or +∞ for scored pixels that are wrong without bias; 0 elsewhere.
[[nodiscard]] ExactReruns find_exact_primitives(const CauseInputs& inputs,
                                                const scene::Image<std::uint32_t>& receivers);

/// Whether no map with these settings, however fine, can show the triangle of a scored receiver: it
/// does not cast, is culled, or does not lie between near and far.
/// @param receivers  The triangle that each pixel shows.
/// @return  1 or 0, by pixel.
[[nodiscard]] scene::Image<std::uint8_t>
find_missing_receivers(const CauseInputs& inputs, const scene::Image<std::uint32_t>& receivers,
                       const scene::TriangleScene& triangles, const scene::Light& light,
                       scene::Cull cull);

} // namespace gnomon::analysis
