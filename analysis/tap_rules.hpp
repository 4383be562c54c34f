#pragma once

#include "analysis/footprint.hpp"
#include "scene/job.hpp"

#include <span>

namespace gnomon::analysis {

/// A map's settings, as far as they decide what a lookup does with its taps.
struct TapRules {
    scene::LookupSettings lookup;
    int resolution_texels = 0;
    bool reversed = false;

    /// The depth of what a map cannot see: the far plane's.
    [[nodiscard]] float farthest_depth() const { return reversed ? 0.0F : 1.0F; }
    /// The depth that linear and hardware lookups find outside the map.
    [[nodiscard]] float border_depth() const
    {
        return (lookup.outside == scene::Outside::shadowed) != reversed ? 0.0F : 1.0F;
    }
    /// The single comparison without bias, as the lookup makes it.
    [[nodiscard]] bool is_lit(float r, float d) const { return reversed ? r >= d : r <= d; }
    /// True when r is beyond the far plane. `clamp` hands out a limited r: there the plane counts
    /// as beyond, which a receiver in it hardly ever is.
    [[nodiscard]] bool is_beyond_far(float r) const;
    /// True when the policy decides all taps of the lookup.
    [[nodiscard]] bool is_policy(float r, std::span<const Tap> taps) const;
};

} // namespace gnomon::analysis
