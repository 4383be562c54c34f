#pragma once

#include "analysis/comparison/evaluation.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/pixels/pixel_layers.hpp"

namespace gnomon::analysis {

/// Which pixels are wrong by their bias, where r and d of a single tap are all that is known: those
/// that r <= d (reversed: r >= d), the verdict without any bias, gets right (V1 of docs/causes.md).
/// @param layers  has `z_light` and `z_map`.
[[nodiscard]] BiasCauses find_bias_causes(const scene::CaseLayers& layers,
                                          const scene::Truth& truth, bool reversed);

} // namespace gnomon::analysis
