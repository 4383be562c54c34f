#include "analysis/presets/preset_result.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "methods/bias_term.hpp"
#include "methods/job_method.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <string_view>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Median light distance of the scored receivers; empty without any.
std::optional<double> median_receiver_m(const Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return std::nullopt;
    }
    const scene::Image<float>& distances = comparison.diagnosis->light_distance_m;
    const auto quantiles = find_quantiles(std::vector<float>(distances.begin(), distances.end()));
    return quantiles ? std::optional<double>{double{quantiles->median}} : std::nullopt;
}

/// A step of the job's depth format at a receiver.
double step_at(const scene::Job& job, const scene::LightFrustum& map, double light_distance_m)
{
    const double depth = DepthMapping{map.stored_range()}.depth(light_distance_m);
    return depth_step(job.shadow_map.depth_format, static_cast<float>(depth));
}

/// The keys of bias terms outside `ReceiverBias` that the job does not leave at their defaults.
std::map<std::string, scene::JobValue> further_keys(const scene::Job& job)
{
    std::map<std::string, scene::JobValue> keys;
    for (const std::string_view name : methods::moving_bias_keys(job)) {
        const scene::Key* key = scene::keys_of(job).find(name);
        if (key != nullptr && key->is_added() && key->value_of(job.method) != key->default_value) {
            keys.emplace(name, key->value_of(job.method));
        }
    }
    return keys;
}

} // namespace

ReceiverBias bias_at(const scene::Job& job, const scene::View& view, double light_distance_m)
{
    const scene::LightFrustum& map = view.first_map();
    ReceiverBias at;
    at.light_distance_m = light_distance_m;
    at.texel_m = map.texel_width_m(light_distance_m, job.shadow_map.resolution_texels);
    at.bias = bias_in_map(job, view, 0, light_distance_m);
    at.slope = double{view.bias.slope};
    at.normal_texels = double{view.bias.normal_texels};
    at.constant_r = at.bias.constant / step_at(job, map, light_distance_m);
    return at;
}

std::optional<FurtherBias> further_bias_at(const scene::Job& job, const scene::View& view,
                                           double light_distance_m, std::optional<double> unit)
{
    FurtherBias further{.keys = further_keys(job)};
    if (further.keys.empty()) {
        return std::nullopt;
    }
    const scene::LightFrustum& map = view.first_map();
    const double texel_m = map.texel_width_m(light_distance_m, job.shadow_map.resolution_texels);
    const double step = step_at(job, map, light_distance_m);
    const double texels = methods::number_in(job, "bias.constant_texels");
    const methods::PolygonOffset offset =
        methods::map_offset(job, view).value_or(methods::PolygonOffset{});
    const double away = map.reversed ? -1 : 1;
    further.constant = bias_of_length(map, texels * texel_m, light_distance_m) +
                       away * double{offset.units} * unit.value_or(step);
    further.constant_m = bias_length_m(map, further.constant, light_distance_m);
    further.constant_texels = further.constant_m / texel_m;
    further.constant_r = further.constant / step;
    further.slope_m = away * double{offset.factor} * texel_m;
    return further;
}

PresetResult preset_result(const Comparison& comparison, const scene::Preset* preset)
{
    PresetResult result;
    result.preset = preset;
    result.job = comparison.job;
    result.metrics = comparison.metrics;
    if (comparison.diagnosis) {
        result.peter_panning = comparison.diagnosis->peter_panning;
    }
    const auto light_distance_m = median_receiver_m(comparison);
    if (light_distance_m && !comparison.view.maps.empty()) {
        result.receiver = bias_at(comparison.job, comparison.view, *light_distance_m);
        std::optional<double> unit;
        if (comparison.drawn_offset) {
            unit = double{comparison.drawn_offset->r.median};
        }
        result.further = further_bias_at(comparison.job, comparison.view, *light_distance_m, unit);
    }
    result.map_bytes = methods::traits(comparison.job).map_bytes;
    return result;
}

} // namespace gnomon::analysis
