#pragma once

#include "methods/lookup_traits.hpp"

#include <string_view>

namespace gnomon::methods {

/// A kernel of a blur: weights along a line, of sum 1.
/// @param weights       "box" (equal) or "gaussian" (binomial coefficients over their sum).
/// @param width_texels  1, 3, 5, 7 or 9.
[[nodiscard]] const Kernel& blur_kernel(std::string_view weights, int width_texels);

} // namespace gnomon::methods
