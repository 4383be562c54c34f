#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/exact_lookup.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The lookups of pixels, traced.
/// @param layers  where they look: the inputs' `job` or `unbiased`.
[[nodiscard]] TracedLookups trace_lookups(const CauseInputs& inputs,
                                          const scene::LookupLayers& layers,
                                          std::span<const std::size_t> pixels);

/// The same.
/// @param points  where they look, in the order of the pixels.
[[nodiscard]] TracedLookups trace_lookups(const CauseInputs& inputs,
                                          std::vector<scene::MapPoint> points,
                                          std::span<const std::size_t> pixels);

/// For each lookup the taps that shadow without bias, by the depths that GL stored.
[[nodiscard]] std::vector<TapSet> shadowing_taps(const CauseInputs& inputs,
                                                 const scene::LookupLayers& layers,
                                                 const TracedLookups& lookups);

/// For each lookup the taps whose texels see the receiver's self-shadowing surface
/// (docs/causes.md).
/// @param asked  the taps in question, by lookup.
[[nodiscard]] std::vector<TapSet> own_taps(const renderers::LightQueries& light,
                                           const TracedLookups& lookups,
                                           std::span<const TapSet> asked);

/// V2 of each lookup, where the method was run over exact depths.
[[nodiscard]] std::vector<float> rerun_biases(const ExactReruns& reruns,
                                              const TracedLookups& lookups, LitShare share);

} // namespace gnomon::analysis
