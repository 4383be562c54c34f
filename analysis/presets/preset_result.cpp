#include "analysis/presets/preset_result.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/comparison.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "methods/list.hpp"

#include <vector>

namespace gnomon::analysis {

namespace {

/// The median light distance of the scored receivers; empty if there are none.
std::optional<double> median_receiver_m(const Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return std::nullopt;
    }
    const scene::Image<float>& distances = comparison.diagnosis->light_distance_m;
    const auto quantiles = find_quantiles(std::vector<float>(distances.begin(), distances.end()));
    return quantiles ? std::optional<double>{double{quantiles->median}} : std::nullopt;
}

/// A step of the job's format at a receiver.
double step_at(const scene::Job& job, const scene::LightFrustum& map, double light_distance_m)
{
    const double depth = DepthMapping{map.stored_range()}.depth(light_distance_m);
    return depth_step(job.shadow_map.depth_format, static_cast<float>(depth));
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

UnexpressedLength length_of(const scene::UnexpressedBias& bias, const scene::Job& job,
                            const scene::View& view, double light_distance_m)
{
    const scene::LightFrustum& map = view.first_map();
    const double texel_m = map.texel_width_m(light_distance_m, job.shadow_map.resolution_texels);
    const double step = step_at(job, map, light_distance_m);
    UnexpressedLength length;
    length.constant = bias_of_length(map, bias.constant_texels * texel_m, light_distance_m) +
                      bias.polygon_units * step;
    length.constant_m = bias_length_m(map, length.constant, light_distance_m);
    length.constant_texels = length.constant_m / texel_m;
    length.constant_r = length.constant / step;
    length.slope_m = bias.polygon_factor * texel_m;
    return length;
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
        if (preset != nullptr && preset->unexpressed) {
            result.unexpressed =
                length_of(*preset->unexpressed, comparison.job, comparison.view, *light_distance_m);
        }
    }
    result.map_bytes = methods::promises(comparison.job).map_bytes;
    return result;
}

} // namespace gnomon::analysis
