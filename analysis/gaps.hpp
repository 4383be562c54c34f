#pragma once

#include "analysis/quantiles.hpp"
#include "scene/exact_light.hpp"
#include "scene/light_frustum.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace gnomon::analysis {

/// Peter-panning as a length: from P to its blocker; empty if nothing pans.
struct Gaps {
    std::optional<Quantiles> metres;
    std::optional<Quantiles> texels; ///< in texels' world widths at P
};

/// @param pixels  blocked in truth, and false lit by the bias.
[[nodiscard]] Gaps measure_gaps(const scene::ExactLight& light, std::span<const std::size_t> pixels,
                                const scene::LightFrustum& frustum, int resolution_texels);

} // namespace gnomon::analysis
