#pragma once

#include "analysis/footprint.hpp"
#include "analysis/lookup_rules.hpp"
#include "analysis/texel_hits.hpp"
#include "scene/exact_light.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Receivers with the taps of their lookups, flattened: as many taps for each.
struct Lookups {
    std::vector<std::size_t> pixels;
    std::vector<Tap> taps;
    std::size_t taps_each = 1;

    [[nodiscard]] std::span<const Tap> taps_of(std::size_t i) const
    {
        return std::span{taps}.subspan(i * taps_each, taps_each);
    }
};

/// V2: for each receiver the smallest bias with which exact depths at the lookup's taps are lit
/// (DESIGN §4); −∞ or +∞ where policy taps decide.
[[nodiscard]] std::vector<float> exact_critical_biases(const LookupRules& rules,
                                                       const Lookups& lookups,
                                                       const TexelHits& hits,
                                                       const scene::ExactLight& light);

} // namespace gnomon::analysis
