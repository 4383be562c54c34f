#pragma once

#include <limits>

namespace gnomon::scene {

/// Infinity as a float32.
inline constexpr float infinity = std::numeric_limits<float>::infinity();

} // namespace gnomon::scene
