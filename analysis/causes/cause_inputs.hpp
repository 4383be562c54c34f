#pragma once

#include "analysis/bias/kept_terms.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/lookup/texel_hits.hpp"
#include "methods/list.hpp"
#include "renderers/light_queries.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>

namespace gnomon::analysis {

/// V2 of a method that does not compare depths: for each pixel the smallest constant bias,
/// including the slope's part, at which the method reaches this share of light over a map of exact
/// depths. If it compares triangles, −∞ or +∞ (`find_exact_primitives`).
struct ExactReruns {
    scene::Image<float> any;  ///< more than 1/256
    scene::Image<float> half; ///< at least one half
    scene::Image<float> full; ///< all but at most 1/256
};

/// Inputs for finding causes.
struct CauseInputs {
    LookupRule rule; ///< without any bias
    int resolution_texels = 0;
    const scene::Truth& truth;
    const scene::LookupLayers& job; ///< V0: positions and depths; the same object as `unbiased` if
                                    ///< no bias moved the lookup (`methods::moves_lookups`)
    const scene::LookupLayers& unbiased;   ///< V1: at the receiver itself, without any bias
    const scene::Image<float>& map_depths; ///< as shaders see them; empty for `nearest`
    const renderers::LightQueries& light;
    /// Known hits of the light's texels, which need no tracing; may be null.
    const TexelHits* known_hits = nullptr;
    /// Whether biases below 0 matter, at which more taps shadow.
    bool asks_below_zero = false;
    /// If the method does not compare depths; else null.
    const ExactReruns* exact_reruns = nullptr;
    /// If the method compares triangles: 1 where no map, however fine, can show the receiver's
    /// triangle (`find_missing_receivers`). Else null.
    const scene::Image<std::uint8_t>* missing_receivers = nullptr;
    /// `map_depths` of `unbiased` if a bias was drawn into the map; else null.
    const scene::Image<float>* unbiased_map_depths = nullptr;
    /// The terms besides constant and slope that V2 keeps for a lit pixel. Null if there are none
    /// or they are unknown.
    const KeptTerms* terms = nullptr;

    /// Where V2 looks up for a lit pixel.
    [[nodiscard]] const scene::LookupLayers& of_lit() const
    {
        return terms != nullptr ? job : unbiased;
    }

    [[nodiscard]] Footprint footprint() const
    {
        return {rule.traits, rule.edge(), resolution_texels};
    }
    /// The depth that GL stored in a texel of the pixel's lookup.
    /// @param layers  `job` or `unbiased`.
    [[nodiscard]] float stored_depth(const scene::LookupLayers& layers, std::size_t pixel,
                                     const scene::Texel& texel) const
    {
        if (rule.traits.has_one_tap()) {
            return layers.samples[pixel].map_depth;
        }
        const bool is_other_map = unbiased_map_depths != nullptr && &layers == &unbiased;
        return at_texel(is_other_map ? *unbiased_map_depths : map_depths, texel);
    }
    /// Whether a tap shadows the unbiased receiver, judged by the stored depth.
    [[nodiscard]] bool shadows(const scene::LookupLayers& layers, std::size_t pixel,
                               const Tap& tap) const
    {
        const float depth =
            tap.is_inside ? stored_depth(layers, pixel, tap.texel) : rule.outside_depth();
        return !rule.is_lit(layers.samples[pixel].receiver_depth, depth);
    }
    /// Whether no map can show the receiver's triangle.
    [[nodiscard]] bool misses_receiver(std::size_t pixel) const
    {
        return missing_receivers != nullptr && (*missing_receivers)[pixel] != 0;
    }
    /// Whether the receiver lies outside the map or beyond far, so that no finer map would show it.
    [[nodiscard]] bool is_uncovered(const Footprint& footprint, std::size_t pixel) const
    {
        return !footprint.is_inside(unbiased.at(pixel)) ||
               rule.is_beyond_far(unbiased.samples[pixel].receiver_depth);
    }
};

/// @throws std::invalid_argument  if layers differ in size, or if map depths are missing.
void require_cause_inputs(const CauseInputs& inputs);

} // namespace gnomon::analysis
