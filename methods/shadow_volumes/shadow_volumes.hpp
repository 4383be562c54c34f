#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// The method "shadow_volumes": no map; what lies in the volumes behind casters is in shadow.
[[nodiscard]] Method shadow_volumes();

} // namespace gnomon::methods
