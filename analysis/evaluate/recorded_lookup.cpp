#include "analysis/evaluate/recorded_lookup.hpp"

#include "analysis/lookup/lit_weight.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/lookup/tap_criticals.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "methods/job_method.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::analysis {
namespace {

/// Calls `visit(pixel, taps)` for every pixel that shows something, several at the same time.
template <typename Visit>
void visit_pixels(const scene::CaseLayers& layers, const scene::LookupLayers& lookup,
                  const LookupRule& rule, const Visit& visit)
{
    const TapCriticals taps{lookup, layers.map_depths, rule};
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        std::vector<double> weights(taps.taps_each());
        std::vector<WeighedCritical> weighed(taps.taps_each());
        const auto is_seen = [&](std::size_t pixel) {
            return !std::isnan(layers.position[pixel].x);
        };
        taps.visit(first, last, is_seen, [&](std::size_t pixel, std::span<const float> criticals) {
            taps.weights(pixel, weights);
            for (std::size_t t = 0; t < weighed.size(); ++t) {
                weighed[t] = {criticals[t], weights[t]};
            }
            visit(pixel, weighed);
        });
    });
}

} // namespace

bool RecordedLookup::answers(const scene::Job& job) const
{
    return methods::traits(job).is_made_of_taps() && !layers_.map_depths.empty();
}

scene::LookupLayers RecordedLookup::own() const
{
    scene::LookupLayers lookup{scene::Image<scene::LookupSample>{layers_.size()}, layers_.texels,
                               layers_.maps};
    lookup.kernel_axes = layers_.kernel_axes;
    for (std::size_t i = 0; i < lookup.samples.pixel_count(); ++i) {
        lookup.samples[i] = {layers_.z_light[i], layers_.z_map[i],
                             layers_.tan_theta.empty() ? 0.0F : layers_.tan_theta[i],
                             layers_.mask[i]};
    }
    return lookup;
}

scene::LookupLayers RecordedLookup::look_up(const scene::Job& job, const scene::View& view) const
{
    const bool is_unbiased = view.bias.constant == 0 && view.bias.slope == 0 &&
                             !methods::moves_lookups(job, view); // as an offset along the normal
    if (is_unbiased && !layers_.unmoved.samples.empty()) {
        return layers_.unmoved;
    }
    scene::LookupLayers lookup = own();
    visit_pixels(layers_, lookup, lookup_rule(job, view),
                 [&](std::size_t pixel, const std::vector<WeighedCritical>& taps) {
                     double lit = 0;
                     double all = 0;
                     for (const auto& [critical, weight] : taps) {
                         lit += critical <= view.bias.constant ? weight : 0;
                         all += weight;
                     }
                     lookup.samples[pixel].verdict = static_cast<float>(lit / all);
                 });
    return lookup;
}

scene::Image<float> RecordedLookup::find_critical_biases(const scene::Job& job,
                                                         const scene::View& view) const
{
    const scene::LookupLayers lookup = own();
    scene::Image<float> criticals{layers_.size()};
    visit_pixels(layers_, lookup, lookup_rule(job, view),
                 [&](std::size_t pixel, std::vector<WeighedCritical>& taps) {
                     criticals[pixel] = smallest_lit_bias(
                         taps, [](double lit, double all) { return lit >= 0.5 * all; });
                 });
    return criticals;
}

} // namespace gnomon::analysis
