#include "analysis/diagnosis/diagnose.hpp"

#include "analysis/causes/pixel_causes.hpp"
#include "analysis/limits/bias_rows.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "analysis/rays/scored_receivers.hpp"
#include "methods/job_method.hpp"
#include "renderers/light_queries.hpp"
#include "scene/infinity.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::analysis {

Softening softening_without_constant(ObservedLookup at_zero,
                                     const std::shared_ptr<LightQueryCache>& exact)
{
    const scene::LookupLayers own = at_zero.layers;
    const scene::Bias bias = at_zero.view.bias;
    LookupCauses causes{exact, std::move(at_zero)};
    const CauseAmounts amounts = causes.causes_of(own, bias.constant, bias.slope).amounts;
    return {amounts.shadow_softening, amounts.light_softening};
}

Diagnosis diagnose(const ComparedLayers& layers, ObservedLookup lookup,
                   const DiagnosisRequest& request, const renderers::Reference& reference)
{
    auto receivers = std::make_shared<ScoredReceivers>(
        layers.receivers, layers.truth, ReceiverUse{.by_many_maps = false, .counts_cells = true});
    auto exact = std::make_shared<LightQueryCache>(layers.triangles, std::move(receivers),
                                                   lookup.job, lookup.view, reference);
    const auto without_constant = std::move(lookup.without_constant);
    LookupAnswers answers{exact, std::move(lookup)};
    std::optional<Softening> at_zero;
    if (without_constant) {
        at_zero = softening_without_constant(without_constant(), exact);
    }
    Diagnosis found = std::move(answers).diagnose(layers.lookup, request, layers.verdict_taps);
    if (at_zero) {
        found.curve.softening_at_zero = at_zero;
    }
    return found;
}

using scene::PixelClass;

namespace {

/// The wrong pixels of a class: row-major indices, ascending.
std::vector<std::size_t> wrong_pixels(const ComparedLayers& layers, PixelClass truth)
{
    const auto& classes = layers.truth.pixel_class;
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (classes[i] == truth &&
            scene::is_lit(layers.lookup.samples[i].verdict) != scene::is_lit(truth)) {
            wrong.push_back(i);
        }
    }
    return wrong;
}

/// The culling that leaves the casters whose shadows the method draws.
scene::Cull cull_of(methods::Casters casters)
{
    return casters == methods::Casters::all ? scene::Cull::none : scene::Cull::back;
}

PixelCauses find_causes(const scene::Job& job, const ComparedLayers& layers,
                        const renderers::LightQueries& light)
{
    PixelCauses causes{scene::Image<PixelCause>{layers.truth.pixel_class.size()}, {}};
    for (const std::size_t pixel : wrong_pixels(layers, PixelClass::lit)) {
        // Nothing crosses the segment, so the rule lights the pixel, as exact depths would at any
        // bias.
        causes.pixels[pixel] = {Cause::precision, Cause::precision, false, -scene::infinity};
    }
    const auto blocked = wrong_pixels(layers, PixelClass::blocked);
    const auto crossed = light.occluded_anywhere(blocked, cull_of(methods::traits(job).casters));
    for (std::size_t i = 0; i < blocked.size(); ++i) {
        const Cause cause = crossed[i] != 0 ? Cause::precision : Cause::coverage;
        causes.pixels[blocked[i]] = {cause, cause, false, -scene::infinity};
    }
    return causes;
}

} // namespace

Diagnosis diagnose_without_map(const scene::Job& job, const scene::View& view,
                               const ComparedLayers& layers, const renderers::Reference& reference)
{
    ScoredReceivers receivers{layers.receivers, layers.truth,
                              ReceiverUse{.by_many_maps = false, .counts_cells = true}};
    const ReceiverGeometry geometry{layers.triangles, view, layers.receivers.triangle};
    const auto light = reference.make_light_queries(job, view, layers.receivers);
    const auto& classes = layers.truth.pixel_class;
    const scene::Image<float> verdicts = criticals_of_verdicts(layers.lookup);
    const PixelCauses causes = find_causes(job, layers, *light);
    const BiasRowInputs rows{classes, layers.lookup, verdicts, causes, lookup_rule(job, view)};
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    constexpr std::array<float, 1> no_bias{0.0F};

    Diagnosis found;
    found.causes = classify_errors(rows, no_bias.front());
    found.light_distance_m = *receivers.light_distance_m(view.first_map(), geometry);
    found.map_error_m = scene::Image<float>{classes.size(), nothing};
    found.peter_panning = find_gaps_at({}, no_bias, {}).front();
    found.cells = count_error_buckets(
                      *receivers.cells(view.first_map(), geometry, layers.triangles), rows, no_bias)
                      .front();
    const scene::Image<float> no_criticals{classes.size(), nothing};
    const BreakdownInputs inputs{layers.truth, layers.lookup, no_criticals, found.map_error_m,
                                 layers.verdict_taps};
    found.by_distance = errors_by_bin(*receivers.distances(view.first_map(), geometry), inputs);
    found.by_angle = errors_by_bin(bin_by_angle(classes, layers.lookup), inputs);
    found.by_object = errors_by_object(layers.truth, layers.lookup, layers.receivers.triangle,
                                       layers.triangles, layers.verdict_taps);
    found.curve.by_distance.push_back(
        {DistanceProfile::At::job_bias, view.bias.constant, found.by_distance});
    return found;
}

} // namespace gnomon::analysis
