#pragma once

#include "analysis/comparison/comparison.hpp"
#include "store/images/exr.hpp"
#include "store/json.hpp"

#include <span>
#include <string>
#include <vector>

namespace gnomon::store {

/// The header of a comparison's EXR files: the job as JSON in `gnomon:job`, the scene, the
/// environment, and the exact inputs as `gnomon:eye` … in hexadecimal.
[[nodiscard]] std::vector<ExrAttribute> exr_header(const analysis::Comparison& comparison);
/// The header of a file of several lights: common values as above, then each light's job and exact
/// inputs as `gnomon:NAME.job`, `gnomon:NAME.eye` ….
/// @param lights  at least one.
[[nodiscard]] std::vector<ExrAttribute> exr_header(std::span<const analysis::Comparison> lights);

/// A number as C99's `%a` writes it, "0x1.8p+1"; reads back bit by bit.
[[nodiscard]] std::string hexadecimal(double value);

/// One exact input: a word, or numbers in hexadecimal.
struct ExactInput {
    std::string name;
    std::vector<std::string> values; ///< one for a scalar or a word
};

/// Every input of the truth and the lookup except the scene, with exact bits.
///
/// Vectors are x y z [m]; `light_clip_from_world` is 16 float32 values, row by row; `half_height`
/// is tan(fov/2), or half the orthographic height [m]. A directional light has `light_direction`; a
/// spot has `light_position`, `light_axis` and `cos_half_cone`, a point light `light_position`.
[[nodiscard]] std::vector<ExactInput> exact_inputs(const scene::View& view);
/// As above; for another renderer's case only the inputs that the case holds.
[[nodiscard]] std::vector<ExactInput> exact_inputs(const analysis::Comparison& comparison);

/// The comparison's job as a JSON object; for another renderer's case only the keys that it gives.
/// A TOML value that is not valid JSON becomes a string.
[[nodiscard]] Json job_object(const analysis::Comparison& comparison);
/// `job_object` as text on one line.
[[nodiscard]] std::string job_json(const analysis::Comparison& comparison);

} // namespace gnomon::store
