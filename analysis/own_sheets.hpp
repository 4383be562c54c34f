#pragma once

#include "analysis/causes.hpp"
#include "analysis/exact_lookup.hpp"
#include "analysis/texel_hits.hpp"

#include <vector>

namespace gnomon::analysis {

/// True for the lookups in which at least half, by weight, of the taps that shadow without bias see
/// the receiver's own sheet (DESIGN §4); false where none shadows.
/// @param hits  of all taps that are inside.
[[nodiscard]] std::vector<bool> sees_own_sheets(const CauseInputs& inputs, const Lookups& lookups,
                                                const TexelHits& hits);

/// The lookups of pixels, and what the light sees through their texels.
struct TracedLookups {
    Lookups lookups;
    TexelHits hits;
};
[[nodiscard]] TracedLookups trace_lookups(const CauseInputs& inputs,
                                          std::span<const std::size_t> pixels);

} // namespace gnomon::analysis
