#pragma once

#include <limits>

namespace gnomon::scene {

/// The float32 that is larger than every finite one.
inline constexpr float infinity = std::numeric_limits<float>::infinity();

} // namespace gnomon::scene
