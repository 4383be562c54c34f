#pragma once

#include "methods/filter_promises.hpp"

#include <cstddef>
#include <span>

namespace gnomon::methods {

/// All filters, in the order of their enumerators.
[[nodiscard]] std::span<const FilterPromises> filters();

[[nodiscard]] const FilterPromises& filter_promises(scene::Filter filter);

/// No filter has more taps than this.
inline constexpr std::size_t most_taps = 81;

} // namespace gnomon::methods
