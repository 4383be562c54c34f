#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// The method "msm": moment shadow maps of four moments. docs/methods/msm.md says what it computes.
[[nodiscard]] Method moment_map();

} // namespace gnomon::methods
