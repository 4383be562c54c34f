#pragma once

#include "analysis/causes/cause_cache.hpp"
#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/pixel_causes.hpp"

namespace gnomon::analysis {

/// Finds why scored lit pixels are wrong or partial, with every bias.
/// @param causes  Of the image's size; set at the lit pixels. Its `filters` may be empty for
///                `nearest`.
/// @param cache  Read and added to; nullptr for filters other than `nearest`.
/// @throws std::invalid_argument  as `require_cause_inputs`.
void find_lit_causes(const CauseInputs& inputs, PixelCauses& causes, CauseCache* cache = nullptr);

} // namespace gnomon::analysis
