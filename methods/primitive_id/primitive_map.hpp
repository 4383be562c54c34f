#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// The method "primitive_id": a map of which triangle the light sees, compared with the receiver's.
[[nodiscard]] Method primitive_map();

} // namespace gnomon::methods
