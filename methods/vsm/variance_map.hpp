#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// The method "vsm": variance shadow maps. docs/methods/vsm.md says what it computes.
[[nodiscard]] Method variance_map();

} // namespace gnomon::methods
