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

/// V2 of a method that compares no depths: for each pixel the smallest constant bias, the slope's
/// part included, with which the method itself, run over a map of exact depths, is lit to this
/// share; of triangles −∞ or +∞ (`find_exact_primitives`).
struct ExactReruns {
    scene::Image<float> any;  ///< more than 1/256
    scene::Image<float> half; ///< at least one half
    scene::Image<float> full; ///< all but at most 1/256
};

/// What the causes are found from.
struct CauseInputs {
    LookupRule rule; ///< without any bias
    int resolution_texels = 0;
    const scene::Truth& truth;
    const scene::LookupLayers&
        job; ///< V0's places and depths; the same object as
             ///< `unbiased` where no bias moved the lookup (`methods::moves_lookups`)
    const scene::LookupLayers& unbiased;   ///< V1: at the receiver itself, all biases zero
    const scene::Image<float>& map_depths; ///< as shaders see them; empty for `nearest`
    const renderers::LightQueries& light;
    const TexelHits* known_hits = nullptr; ///< of the light's texels, not to be traced again
    /// Whether biases below 0 are asked about, with which taps shadow that do not without bias.
    bool asks_below_zero = false;
    /// Where no depths are compared; else nullptr.
    const ExactReruns* exact_reruns = nullptr;
    /// Of methods that compare triangles 1 where no map can show the receiver's own, however fine
    /// (`find_missing_receivers`); else nullptr.
    const scene::Image<std::uint8_t>* missing_receivers = nullptr;
    /// `map_depths` of `unbiased` where a bias was drawn into the map; else nullptr.
    const scene::Image<float>* unbiased_map_depths = nullptr;
    /// What V2 keeps for a lit pixel beside constant and slope; nullptr: there is no more, or it is
    /// not known.
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
    /// The depth that GL stored in a texel that the pixel's lookup reads.
    /// @param layers  the lookup: `job` or `unbiased`.
    [[nodiscard]] float stored_depth(const scene::LookupLayers& layers, std::size_t pixel,
                                     const scene::Texel& texel) const
    {
        if (rule.traits.has_one_tap()) {
            return layers.samples[pixel].map_depth;
        }
        const bool is_other_map = unbiased_map_depths != nullptr && &layers == &unbiased;
        return at_texel(is_other_map ? *unbiased_map_depths : map_depths, texel);
    }
    /// Whether a tap shadows without bias, by the depth that GL stored.
    [[nodiscard]] bool shadows(const scene::LookupLayers& layers, std::size_t pixel,
                               const Tap& tap) const
    {
        const float depth =
            tap.is_inside ? stored_depth(layers, pixel, tap.texel) : rule.outside_depth();
        return !rule.is_lit(layers.samples[pixel].receiver_depth, depth);
    }
    /// Whether the receiver's triangle would have to be in the map, and cannot.
    [[nodiscard]] bool misses_receiver(std::size_t pixel) const
    {
        return missing_receivers != nullptr && (*missing_receivers)[pixel] != 0;
    }
    /// True where the receiver lies outside the map or beyond far, so that no finer map would see
    /// it.
    [[nodiscard]] bool is_uncovered(const Footprint& footprint, std::size_t pixel) const
    {
        return !footprint.is_inside(unbiased.at(pixel)) ||
               rule.is_beyond_far(unbiased.samples[pixel].receiver_depth);
    }
};

/// @throws std::invalid_argument  if layers differ in size, or map depths are missing.
void require_cause_inputs(const CauseInputs& inputs);

} // namespace gnomon::analysis
