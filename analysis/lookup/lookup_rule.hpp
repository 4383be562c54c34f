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

/// What a lookup's samples mean, as raster_gl/shaders/lookup.frag does it: the part of a job,
/// beside the constant bias, that turns depths into verdicts.
struct LookupRule {
    methods::LookupTraits traits;
    scene::Outside outside = scene::Outside::lit;
    bool reversed = false;
    float slope = 0;        ///< depth units per unit of tan θ
    bool has_seams = false; ///< the maps are the faces of a cube
    /// What the constant bias is multiplied with in each map (`scene::View::bias_scales`).
    std::vector<float> bias_scales = {};

    /// The comparison of a receiver's depth with a map's.
    ///
    ///     fl(r − bias) <= d      reversed:   fl(r + bias) >= d
    ///
    /// @param bias  The whole of it: fl(fl(constant · scale) + slope · tan θ).
    [[nodiscard]] bool is_lit(float r, float d, float bias = 0) const
    {
        return reversed ? r + bias >= d : r - bias <= d;
    }
    /// What the constant bias is multiplied with for a pixel that reads this map.
    [[nodiscard]] float bias_scale(int map) const
    {
        return bias_scales.empty() ? 1.0F : bias_scales[static_cast<std::size_t>(map)];
    }
    [[nodiscard]] MapEdge edge() const { return map_edge(outside, has_seams); }
    /// The depth of what a map cannot see: the far plane's.
    [[nodiscard]] float farthest_depth() const { return reversed ? 0.0F : 1.0F; }
    /// The depth that stands for a tap outside the map: that of GL's border where the filter
    /// interpolates; else infinitely far or near, so that the comparison is the border mode's
    /// whatever the bias.
    [[nodiscard]] float outside_depth() const;
    /// The critical bias of what the border mode decides: −∞ lit, +∞ shadowed.
    [[nodiscard]] float border_critical_bias() const
    {
        return outside == scene::Outside::shadowed ? scene::infinity : -scene::infinity;
    }
    /// True when r is beyond the far plane. `clamp` limits r to [0, 1], so an r on
    /// the far plane counts as beyond it.
    [[nodiscard]] bool is_beyond_far(float r) const;
    /// True when the border mode decides all taps of the lookup.
    [[nodiscard]] bool border_decides(float r, std::span<const Tap> taps) const;
};

/// The rule of a job and the view that it was resolved to.
[[nodiscard]] LookupRule lookup_rule(const scene::Job& job, const scene::View& view);

/// Which of so many equal taps decides a verdict: counted from 0, in the order of critical biases
/// or depths; with it half of them, rounded up, are lit.
[[nodiscard]] constexpr std::size_t deciding_rank(std::size_t tap_count)
{
    return (tap_count + 1) / 2 - 1;
}

} // namespace gnomon::analysis
