#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// The method "evsm": exponential variance shadow maps. docs/methods/evsm.md says what it computes.
[[nodiscard]] Method exponential_variance_map();

} // namespace gnomon::methods
