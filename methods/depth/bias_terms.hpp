#pragma once

#include "methods/bias_term.hpp"

#include <span>

namespace gnomon::methods {

/// The bias terms of a map of depths, in the order of their keys.
[[nodiscard]] std::span<const BiasTerm> bias_terms();

} // namespace gnomon::methods
