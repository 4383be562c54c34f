#pragma once

#include "cpp/serve.hpp"

#include <vector>

namespace engine {

/// What an adapter's mask is made of: what it takes out of the engine's shader, or two of the
/// engine's own pictures.
enum class Mask { shader, picture };

/// The mask of two pictures of a white surface under the scene's light alone: with shadows over
/// without. `valid` is 0 where it is too dark without.
/// @param shadowed, unshadowed  Four numbers a pixel, rows from the top, linear, in 32-bit floats:
///                              1 is about what a surface that faces the light has.
/// @return  `shadow` in [0, 1], and `valid`.
[[nodiscard]] std::vector<Floats> mask_of_pictures(const std::vector<float>& shadowed,
                                                   const std::vector<float>& unshadowed,
                                                   const Scene& scene);

} // namespace engine
