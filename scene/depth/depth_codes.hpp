#pragma once

#include "scene/depth/depth_format.hpp"

#include <cstdint>

namespace gnomon::scene {

/// The code that a colour format stores of a value: of floats their bits, nearest with ties to the
/// even one; of rgba8 its four bytes, the first one uppermost (docs/depth_precision.md#rgba8).
/// @param format  r32f, r16f or rgba8
/// @param value   in [0, 1]
/// @throws std::invalid_argument  for another format.
[[nodiscard]] std::uint32_t colour_code(DepthFormat format, float value);

/// The value that a colour format's code stands for: what lookups see of it.
/// @throws std::invalid_argument  for another format.
[[nodiscard]] float colour_value(DepthFormat format, std::uint32_t code);

/// The code of depth 1, in any format: 2^bits − 1, or that of a colour format.
[[nodiscard]] std::uint32_t code_of_one(DepthFormat format);

} // namespace gnomon::scene
