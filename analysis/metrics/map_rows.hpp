#pragma once

#include "analysis/limits/bias_rows.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "scene/pixels/map_texels.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The errors of the pixels that read each of a light's maps, at each of several biases: those that
/// `errors_by_map` finds of GL's own runs with these biases.
/// @param maps       that the pixels read; empty where the light has but one.
/// @param map_count  of the light.
/// @param biases     Ascending, 0 or normal.
/// @return  By bias, and there by map; for a light with one map none for each bias.
/// @throws std::invalid_argument  as `count_rows`.
[[nodiscard]] std::vector<std::vector<MapErrors>> count_map_errors(const scene::MapIndices& maps,
                                                                   std::size_t map_count,
                                                                   const BiasRowInputs& inputs,
                                                                   std::span<const float> biases);

} // namespace gnomon::analysis
