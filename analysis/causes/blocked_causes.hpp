#pragma once

#include "analysis/causes/cause_cache.hpp"
#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "scene/image.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// Finds why scored blocked pixels are wrong or partial, with every bias: no repair of theirs is
/// their own shadow (docs/causes.md).
/// @param wanted  1 for the pixels in question, all of them blocked.
/// @param causes  Of the image's size; set at those pixels.
/// @param cache  Read and added to; nullptr for filters other than `nearest`.
/// @throws std::invalid_argument  as `require_cause_inputs`.
void find_blocked_causes(const CauseInputs& inputs, const scene::Image<std::uint8_t>& wanted,
                         PixelCauses& causes, CauseCache* cache = nullptr);

} // namespace gnomon::analysis
