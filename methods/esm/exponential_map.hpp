#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// The method "esm": exponential shadow maps. docs/methods/esm.md says what it computes.
[[nodiscard]] Method exponential_map();

} // namespace gnomon::methods
