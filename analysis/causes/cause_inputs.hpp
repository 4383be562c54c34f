#pragma once

#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/lookup/texel_hits.hpp"
#include "methods/depth/filters.hpp"
#include "scene/job/job.hpp"
#include "scene/light/exact_light.hpp"
#include "scene/pixel_layers.hpp"

#include <cstddef>

namespace gnomon::analysis {

/// What the causes are found from.
struct CauseInputs {
    scene::LookupSettings lookup;
    int resolution_texels = 0;
    bool reversed = false;
    const scene::TruthLayers& truth;
    const scene::LookupLayers& job;        ///< V0's places and depths; the same object as
                                           ///< `unbiased` where no normal offset moved the lookup
    const scene::LookupLayers& unbiased;   ///< V1: at the receiver itself, all biases zero
    const scene::Image<float>& map_depths; ///< as shaders see them; empty for `nearest`
    const scene::ExactLight& light;
    const TexelHits* known_hits = nullptr; ///< of the light's texels, not to be traced again
    /// Whether biases below 0 are asked about, with which taps shadow that do not without bias.
    bool asks_below_zero = false;

    [[nodiscard]] const methods::FilterPromises& promises() const
    {
        return methods::filter_promises(lookup.filter);
    }
    /// Without any bias.
    [[nodiscard]] LookupRule rule() const { return {lookup.filter, lookup.outside, reversed, 0}; }
    /// The depth that GL stored in a texel that the pixel's lookup reads.
    /// @param layers  the lookup: `job` or `unbiased`.
    [[nodiscard]] float stored_depth(const scene::LookupLayers& layers, std::size_t pixel,
                                     const scene::Texel& texel) const
    {
        // The map's rows are counted from the top, texels from the bottom.
        return promises().has_one_tap() ? layers.samples[pixel].map_depth
                                        : map_depths(texel.x, resolution_texels - 1 - texel.y);
    }
    /// Whether a tap shadows without bias, by the depth that GL stored.
    [[nodiscard]] bool shadows(const scene::LookupLayers& layers, std::size_t pixel,
                               const Tap& tap) const
    {
        const LookupRule without = rule();
        const float depth =
            tap.is_inside ? stored_depth(layers, pixel, tap.texel) : without.outside_depth();
        return !without.is_lit(layers.samples[pixel].receiver_depth, depth);
    }
    /// True where the receiver lies outside the map or beyond far, so that no finer map would see
    /// it.
    [[nodiscard]] bool is_uncovered(const Footprint& footprint, std::size_t pixel) const
    {
        return !footprint.is_inside(unbiased.texels[pixel]) ||
               rule().is_beyond_far(unbiased.samples[pixel].receiver_depth);
    }
};

/// @throws std::invalid_argument  if layers differ in size, or map depths are missing.
void require_cause_inputs(const CauseInputs& inputs);

} // namespace gnomon::analysis
