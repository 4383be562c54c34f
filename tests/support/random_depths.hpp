#pragma once

#include "scene/image.hpp"

#include <random>

namespace gnomon::tests {

/// Depths in blocks of 8 × 8 texels, of which each has a spread of its own, down to none.
[[nodiscard]] scene::Image<float> random_depths(std::mt19937& random, int side);

} // namespace gnomon::tests
