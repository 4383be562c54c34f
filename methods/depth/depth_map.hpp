#pragma once

#include "methods/bias_term.hpp"
#include "methods/lookup_traits.hpp"
#include "methods/method.hpp"
#include "methods/passes.hpp"
#include "scene/settings/filter.hpp"

#include <cstdint>
#include <span>

namespace gnomon::methods {

/// The bias terms of depth maps, in the order of their keys.
[[nodiscard]] std::span<const BiasTerm> bias_terms();

/// All filters, in the order of the enumerators.
[[nodiscard]] std::span<const FilterChoice> filters();

/// The traits of lookups in a depth map with this filter; `map_bytes` is 0.
[[nodiscard]] const LookupTraits& filter_traits(scene::Filter filter);

/// The GL passes of a filter.
[[nodiscard]] Passes filter_passes(scene::Filter filter);

/// The method "depth": compares the receiver's depth with a map of depths seen from the light.
[[nodiscard]] Method depth_map();

/// Memory of the job's maps [bytes]; u-formats as if GL had them.
[[nodiscard]] std::uint64_t map_bytes(const scene::Job& job);

} // namespace gnomon::methods
