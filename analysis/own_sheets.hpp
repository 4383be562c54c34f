#pragma once

#include "analysis/causes.hpp"
#include "analysis/lookup/exact_lookup.hpp"

#include <span>
#include <vector>

namespace gnomon::analysis {

/// True for the lookups in which at least half, by weight, of the taps that shadow without bias see
/// the receiver's own sheet (DESIGN §4); false where none shadows.
[[nodiscard]] std::vector<bool> sees_own_sheets(const CauseInputs& inputs,
                                                const TracedLookups& lookups);

/// The lookups of pixels, traced.
[[nodiscard]] TracedLookups trace_lookups(const CauseInputs& inputs,
                                          std::span<const std::size_t> pixels);

/// Of these blocked pixels those that the map without bias shadows by other surfaces than the
/// receiver's own: only their shadows can be detached, where the others had nothing attached. A
/// filter's verdict is theirs if their taps, by weight, are enough for it; `linear` has one
/// comparison, which is theirs unless `sees_own_sheets`.
[[nodiscard]] std::vector<std::size_t> detached_pixels(const CauseInputs& inputs,
                                                       std::span<const std::size_t> pixels);

} // namespace gnomon::analysis
