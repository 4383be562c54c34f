#pragma once

#include "analysis/comparison.hpp"
#include "store/images/image_encoding.hpp"

#include <vector>

namespace gnomon::store {

/// What the header of a comparison's EXR files holds: the job as JSON in `gnomon:job`, the scene,
/// the environment, and the exact inputs as `gnomon:eye` … in hexadecimal.
[[nodiscard]] std::vector<ExrAttribute> exr_header(const analysis::Comparison& comparison);

} // namespace gnomon::store
