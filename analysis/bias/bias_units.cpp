#include "analysis/bias/bias_units.hpp"

#include "analysis/depth/depth_mapping.hpp"
#include "analysis/lookup/bias_order.hpp"
#include "analysis/pixels/checks.hpp"
#include "analysis/pixels/pixel_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::analysis {

double bias_length_m(const scene::LightFrustum& frustum, double bias, double light_distance_m)
{
    return DepthMapping{frustum.stored_range()}.bias_length_m(bias, light_distance_m);
}

double bias_of_length(const scene::LightFrustum& frustum, double length_m, double light_distance_m)
{
    return DepthMapping{frustum.stored_range()}.bias_of_length(length_m, light_distance_m);
}

double depth_per_metre(const scene::LightFrustum& frustum, double light_distance_m)
{
    return DepthMapping{frustum.stored_range()}.depth_per_metre(light_distance_m);
}

double depth_step(scene::DepthFormat format, float depth)
{
    switch (traits_of(format).spacing) {
    case scene::Spacing::even:
        return 1.0 / (std::ldexp(1.0, format.bits) - 1.0);
    case scene::Spacing::floating:
        return scene::float_step(format, double{depth});
    case scene::Spacing::packed:
        break;
    }
    return 1.0 / 255;
}

double depth_step_length_m(const scene::LightFrustum& frustum, scene::DepthFormat format,
                           double light_distance_m)
{
    const double depth = DepthMapping{frustum.stored_range()}.depth(light_distance_m);
    return bias_length_m(frustum, depth_step(format, static_cast<float>(depth)), light_distance_m);
}

BiasMap map_biases(const BiasMapInputs& inputs)
{
    require_equal_sizes(
        "map_biases", inputs.classes.size(),
        {inputs.criticals.size(), inputs.lookup.samples.size(), inputs.light_distance_m.size()});
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    const scene::ImageSize size = inputs.classes.size();
    BiasMap map{scene::Image<float>{size, none}, scene::Image<float>{size, none},
                scene::Image<float>{size, none}, scene::Image<float>{size, none}};
    const auto fill = [&](std::size_t i) {
        const float critical = inputs.criticals[i];
        const bool allows_all = critical == std::numeric_limits<float>::infinity();
        const bool is_allowed = scene::is_blocked(inputs.classes[i]) && !allows_all;
        const double bias{is_allowed ? previous_bias(critical) : critical};
        const auto map_of = static_cast<std::size_t>(scene::map_of(inputs.maps.of_pixels, i));
        const double scale = inputs.bias_scales.empty() ? 1.0 : double{inputs.bias_scales[map_of]};
        const scene::LightFrustum& frustum = inputs.maps.map_of(i);
        const double light_distance_m{inputs.light_distance_m[i]};
        const double length_m = bias_length_m(frustum, scale * bias, light_distance_m);
        const double texel_m =
            frustum.texel_width_m(light_distance_m, inputs.maps.resolution_texels);
        const float depth = inputs.lookup.samples[i].receiver_depth;
        map.depth[i] = static_cast<float>(bias);
        map.metres[i] = static_cast<float>(length_m);
        map.texels[i] = static_cast<float>(length_m / texel_m);
        map.steps[i] = static_cast<float>(scale * bias / depth_step(inputs.depth_format, depth));
    };
    for_each_run(inputs.classes.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            if (scene::is_scored(inputs.classes[i])) {
                fill(i);
            }
        }
    });
    return map;
}

} // namespace gnomon::analysis
