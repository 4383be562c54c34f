#pragma once

#include "analysis/bias/kept_terms.hpp"
#include "renderers/rasterizer.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// GL, asked again about a lookup whose other biases no formula tells.
struct LookupReruns {
    /// With other constant and slope biases.
    std::function<scene::LookupLayers(float constant, float slope)> look_up;
    /// The critical bias of each pixel, with another slope.
    std::function<scene::Image<float>(float slope)> find_critical_biases;
};

/// The method itself, run over exact depths.
struct ExactRun {
    /// The critical biases (`ExactReruns`), one image for each of `lit_from`. Empty where the
    /// verdict does not rise with the bias.
    /// @param other  biases beside constant and slope, that place the lookup.
    std::function<std::vector<scene::Image<float>>(
        const renderers::ExactDepths&, const scene::Bias& other, std::span<const float> lit_from)>
        find_critical_biases;
    /// The verdicts with each of the biases.
    std::function<std::vector<scene::Image<float>>(const renderers::ExactDepths&,
                                                   std::span<const scene::Bias>)>
        look_up;
    /// Where in each texel (`LightQueries::texel_depths`) the depths are to be.
    std::vector<scene::Vec2d> places = {scene::texel_centre};
    int layers = 1; ///< surfaces of each that are wanted: 2 with the second, at texel centres
};

/// One GL lookup, and what it was made with.
struct ObservedLookup {
    scene::Job job;
    scene::View view;
    scene::LookupLayers layers;          ///< with any constant and slope bias
    scene::LookupLayers unbiased = {};   ///< without any bias; empty where it follows from `layers`
    scene::Image<float> map_depths = {}; ///< as shaders see them; empty for `nearest`
    /// The same of the map without the offset that it was drawn with; empty: there was none.
    scene::Image<float> unbiased_map_depths = {};
    /// What the other bias terms did; empty if the job has only a constant and a slope, or if
    /// nobody recorded it.
    std::optional<KeptTerms> terms = {};
    /// Empty if a formula gives the other biases, or if nothing does.
    std::optional<LookupReruns> reruns = {};
    /// Empty where causes are exact.
    std::optional<ExactRun> exact_run = {};
    /// Looks up again with a constant bias of 0, for fractions without a bias curve. Empty: there
    /// is a curve, the bias is 0 already, or nobody recorded such a lookup.
    std::function<ObservedLookup()> without_constant = {};
};

/// Draws what a job's lookups are asked of, or has it.
using DrawnSource = std::function<renderers::Drawn()>;

/// Observes what must be known of a lookup beside its layers. What is drawn lives on
/// in the result only where the result looks up again.
/// @param triangles, rasterizer  must outlive what is returned.
[[nodiscard]] ObservedLookup observe_lookup(const scene::Job& job, const scene::View& view,
                                            const scene::TriangleScene& triangles,
                                            scene::LookupLayers layers, const DrawnSource& drawn,
                                            renderers::Rasterizer& rasterizer);

} // namespace gnomon::analysis
