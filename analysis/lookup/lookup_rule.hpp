#pragma once

#include "analysis/lookup/footprint.hpp"
#include "methods/lookup_traits.hpp"
#include "scene/infinity.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// How depths become verdicts, as in raster_gl/shaders/lookup.frag: the part of a job that matters,
/// without the constant bias.
struct LookupRule {
    methods::LookupTraits traits;
    scene::Outside outside = scene::Outside::lit;
    bool reversed = false;
    float slope = 0;        ///< depth units per unit of tan θ
    bool has_seams = false; ///< the maps are the faces of a cube
    /// Factor of the constant bias in each map (`scene::View::bias_scales`).
    std::vector<float> bias_scales = {};

    /// Compares a receiver's depth with a map's.
    ///
    ///     fl(r − bias) <= d      reversed:   fl(r + bias) >= d
    ///
    /// @param bias  The total bias: fl(fl(constant · scale) + slope · tan θ).
    [[nodiscard]] bool is_lit(float r, float d, float bias = 0) const
    {
        return reversed ? r + bias >= d : r - bias <= d;
    }
    /// Factor of the constant bias for a pixel that reads this map.
    [[nodiscard]] float bias_scale(int map) const
    {
        return bias_scales.empty() ? 1.0F : bias_scales[static_cast<std::size_t>(map)];
    }
    [[nodiscard]] MapEdge edge() const { return map_edge(outside, has_seams); }
    /// The depth of an empty map: the far plane's.
    [[nodiscard]] float farthest_depth() const { return reversed ? 0.0F : 1.0F; }
    /// The depth of a tap outside the map: GL's border depth if the filter interpolates. Otherwise
    /// infinitely far or near, so that the border mode decides at any bias.
    [[nodiscard]] float outside_depth() const;
    /// The critical bias where the border mode decides: −∞ lit, +∞ shadowed.
    [[nodiscard]] float border_critical_bias() const
    {
        return outside == scene::Outside::shadowed ? scene::infinity : -scene::infinity;
    }
    /// Whether r is beyond the far plane. `clamp` limits r to [0, 1], so r on the far plane counts
    /// as beyond it.
    [[nodiscard]] bool is_beyond_far(float r) const;
    /// Whether the border mode decides all taps of the lookup.
    [[nodiscard]] bool border_decides(float r, std::span<const Tap> taps) const;
};

/// The rule of a job, given the view resolved from it.
[[nodiscard]] LookupRule lookup_rule(const scene::Job& job, const scene::View& view);

/// Rank of the tap that decides a verdict, among equal taps in the order of critical biases or
/// depths; starts at 0. Up to it, half of the taps, rounded up, are lit.
[[nodiscard]] constexpr std::size_t deciding_rank(std::size_t tap_count)
{
    return (tap_count + 1) / 2 - 1;
}

} // namespace gnomon::analysis
