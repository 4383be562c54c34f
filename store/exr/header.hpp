#pragma once

#include "analysis/comparison/comparison.hpp"
#include "store/images/exr.hpp"

#include <span>
#include <vector>

namespace gnomon::store {

/// What the header of a comparison's EXR files holds: the job as JSON in `gnomon:job`, the scene,
/// the environment, and the exact inputs as `gnomon:eye` … in hexadecimal.
[[nodiscard]] std::vector<ExrAttribute> exr_header(const analysis::Comparison& comparison);
/// That of a file of several lights: what they have in common as above, then of each light its job
/// and exact inputs as `gnomon:NAME.job`, `gnomon:NAME.eye` ….
/// @param lights  at least one.
[[nodiscard]] std::vector<ExrAttribute> exr_header(std::span<const analysis::Comparison> lights);

} // namespace gnomon::store
