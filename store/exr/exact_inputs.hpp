#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>
#include <vector>

namespace gnomon::store {

/// A number as C99's `%a` writes it, "0x1.8p+1": reading it back gives the same bits.
[[nodiscard]] std::string hexadecimal(double value);

/// One exact input: a word, or numbers in hexadecimal.
struct ExactInput {
    std::string name;
    std::vector<std::string> values; ///< one for a scalar or a word
};

/// Everything beside the scene that decides the truth and the lookup, in the very bits used.
///
/// Vectors are x y z [m]; `light_clip_from_world` is 16 float32 values, row by row; `half_height`
/// is tan(fov/2), or half the orthographic height [m]. A directional light has `light_direction`; a
/// spot has `light_position`, `light_axis` and `cos_half_cone`, a point light `light_position`.
[[nodiscard]] std::vector<ExactInput> exact_inputs(const scene::View& view);
/// Those of a comparison; of another renderer's case only what the case tells.
[[nodiscard]] std::vector<ExactInput> exact_inputs(const analysis::Comparison& comparison);

} // namespace gnomon::store
