#pragma once

#include "scene/exact_light.hpp"
#include "scene/light_frustum.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::analysis {

/// Order statistics of a set of lengths; the q-quantile of n values is the ⌈q·n⌉-th smallest.
struct LengthStatistics {
    double median = 0;
    double p95 = 0;
    double max = 0;
};

/// Peter-panning as a length: from P to its blocker.
struct Gaps {
    std::optional<LengthStatistics> metres; ///< empty: nothing pans
    std::optional<LengthStatistics> texels; ///< in texels' world widths at P
};

/// @param pixels  false lit by the bias.
[[nodiscard]] Gaps measure_gaps(const scene::ExactLight& light, std::span<const std::size_t> pixels,
                                const scene::LightFrustum& frustum, int resolution_texels);

} // namespace gnomon::analysis
