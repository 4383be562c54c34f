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

/// Repeats a lookup in GL for biases that no formula evaluates.
struct LookupReruns {
    /// Looks up at another constant and slope bias.
    std::function<scene::LookupLayers(float constant, float slope)> look_up;
    /// Finds the critical bias of each pixel at another slope.
    std::function<scene::Image<float>(float slope)> find_critical_biases;
};

/// Runs the method itself over exact depths.
struct ExactRun {
    /// Finds the critical biases (`ExactReruns`), one image for each of `lit_from`. Empty if the
    /// verdict is not monotone in the bias.
    /// @param other  Biases besides constant and slope, which place the lookup.
    std::function<std::vector<scene::Image<float>>(
        const renderers::ExactDepths&, const scene::Bias& other, std::span<const float> lit_from)>
        find_critical_biases;
    /// Finds the verdicts at each of the biases.
    std::function<std::vector<scene::Image<float>>(const renderers::ExactDepths&,
                                                   std::span<const scene::Bias>)>
        look_up;
    /// Positions within each texel (`LightQueries::texel_depths`) of the depths.
    std::vector<scene::Vec2d> places = {scene::texel_centre};
    int layers = 1; ///< number of surfaces; 2 adds the second one, at texel centres
};

/// One GL lookup, with its inputs.
struct ObservedLookup {
    scene::Job job;
    scene::View view;
    scene::LookupLayers layers;          ///< at some constant and slope bias
    scene::LookupLayers unbiased = {};   ///< without any bias; empty if it follows from `layers`
    scene::Image<float> map_depths = {}; ///< as shaders see them; empty for `nearest`
    /// The depths of the map drawn without its offset; empty if it has none.
    scene::Image<float> unbiased_map_depths = {};
    /// The effect of the other bias terms. Empty if the job has only a constant and a slope, or if
    /// they were not recorded.
    std::optional<KeptTerms> terms = {};
    /// Empty if a formula evaluates other biases, or if nothing does.
    std::optional<LookupReruns> reruns = {};
    /// Empty if causes can be found without running the method.
    std::optional<ExactRun> exact_run = {};
    /// Looks up again at a constant bias of 0, for fractions without a bias curve. Empty if there
    /// is a curve, if the bias is 0 already, or if no such lookup was recorded.
    std::function<ObservedLookup()> without_constant = {};
};

/// Returns the map and receivers for a job's lookups; draws them if needed.
using DrawnSource = std::function<renderers::Drawn()>;

/// Gathers what is needed of a lookup besides its layers. The result keeps the drawn map alive only
/// if it looks up again.
/// @param triangles, rasterizer  Must outlive the result.
[[nodiscard]] ObservedLookup observe_lookup(const scene::Job& job, const scene::View& view,
                                            const scene::TriangleScene& triangles,
                                            scene::LookupLayers layers, const DrawnSource& drawn,
                                            renderers::Rasterizer& rasterizer);

} // namespace gnomon::analysis
