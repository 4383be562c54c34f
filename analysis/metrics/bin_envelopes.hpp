#pragma once

#include "analysis/metrics/breakdown.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <span>
#include <vector>

namespace gnomon::analysis {

/// Sets the formula's envelope beside the map errors of bins by light distance: the largest
/// `error_envelope_m` in each bin, in any of the light's maps, as far as it lies between near and
/// far.
/// Source: docs/depth_precision.md#envelope.
void add_envelopes(std::vector<ErrorBin>& by_distance, std::span<const scene::LightFrustum> maps,
                   scene::DepthFormat format);

} // namespace gnomon::analysis
