#pragma once

#include "methods/lookup_traits.hpp"
#include "methods/method.hpp"
#include "methods/passes.hpp"
#include "scene/settings/filter.hpp"

#include <span>

namespace gnomon::methods {

/// All filters, in the order of their enumerators.
[[nodiscard]] std::span<const FilterChoice> filters();

/// What a filter promises of lookups in a map of depths, whose memory is left 0.
[[nodiscard]] const LookupTraits& filter_traits(scene::Filter filter);

/// What GL is to do for a filter.
[[nodiscard]] Passes filter_passes(scene::Filter filter);

} // namespace gnomon::methods
