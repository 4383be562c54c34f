#include "analysis/metrics/map_facts.hpp"

#include "analysis/bias/bias_units.hpp"

namespace gnomon::analysis {

MapBias bias_in_map(const scene::Job& job, const scene::View& view, std::size_t map,
                    double light_distance_m)
{
    const scene::LightFrustum& frustum = view.maps.at(map);
    const scene::Bias& bias = view.bias;
    const double scale = view.bias_scales.empty() ? 1.0 : double{view.bias_scales[map]};
    const double texel_m =
        frustum.texel_width_m(light_distance_m, job.shadow_map.resolution_texels);
    MapBias in_map;
    in_map.constant = double{bias.constant} * scale;
    in_map.constant_m = bias_length_m(frustum, in_map.constant, light_distance_m);
    in_map.constant_texels = in_map.constant_m / texel_m;
    in_map.slope_m = bias_length_m(frustum, double{bias.slope}, light_distance_m);
    in_map.normal_offset_m = double{bias.normal_texels} * texel_m;
    return in_map;
}

MapFacts facts_of_map(const scene::Job& job, const scene::View& view, std::size_t map)
{
    const scene::LightFrustum& frustum = view.maps.at(map);
    MapFacts facts;
    facts.name = view.map_name(map);
    facts.near_m = frustum.near_m;
    facts.far_m = frustum.far_m;
    facts.texel_m = frustum.texel_width_m(1.0, job.shadow_map.resolution_texels);
    const scene::ViewSlices& slices = view.slices;
    if (slices.ends.empty()) {
        return facts;
    }
    facts.end_m = double{slices.ends[map]};
    facts.begin_m = double{map == 0 ? slices.begin : slices.ends[map - 1]};
    facts.bias = bias_in_map(job, view, map, 1.0);
    return facts;
}

std::vector<MapResult> results_of_maps(const scene::Job& job, const scene::View& view,
                                       const std::vector<MapErrors>& errors)
{
    std::vector<MapResult> results;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        results.push_back({facts_of_map(job, view, i), errors[i]});
    }
    return results;
}

} // namespace gnomon::analysis
