#include "analysis/metrics/map_results.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/limits/error_segments.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/pixels/checks.hpp"

#include <cmath>
#include <cstdint>

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

namespace {

/// A cell for each map, with its pixels but without errors.
CellMap cells_by_map(const scene::Image<scene::PixelClass>& classes, const scene::MapIndices& maps,
                     std::size_t map_count)
{
    require_equal_sizes("count_map_errors", classes.size(), {maps.size()});
    CellMap map{scene::Image<std::uint16_t>{classes.size(), CellMap::none},
                std::vector<ErrorBucket>(map_count)};
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_scored(classes[i])) {
            map.cell[i] = maps[i];
            ErrorBucket& cell = map.cells.at(maps[i]);
            ++(scene::is_lit(classes[i]) ? cell.lit : cell.blocked);
        }
    }
    return map;
}

/// @param units  Of a whole pixel: amounts are added as integers, as in `errors_by_map`.
MapErrors errors_of(const ErrorBucket& cell, std::int64_t units)
{
    MapErrors errors{{cell.lit, cell.blocked}, {}};
    const auto whole = static_cast<double>(units);
    std::int64_t shadow = 0;
    std::int64_t light = 0;
    for (const KindOfError& kind : cell.errors) {
        (kind.is_false_lit ? errors.counts.false_lit : errors.counts.false_shadow) += kind.pixels;
        (kind.is_false_lit ? light : shadow) += std::llrint(kind.amount * whole);
        errors.causes.by_cause[static_cast<std::size_t>(kind.cause)] += kind.pixels;
        errors.causes.by_label[static_cast<std::size_t>(kind.label)] += kind.pixels;
    }
    errors.counts.shadow_amount = static_cast<double>(shadow) / whole;
    errors.counts.light_amount = static_cast<double>(light) / whole;
    return errors;
}

} // namespace

std::vector<std::vector<MapErrors>> count_map_errors(const scene::MapIndices& maps,
                                                     std::size_t map_count,
                                                     const BiasRowInputs& inputs,
                                                     std::span<const float> biases)
{
    std::vector<std::vector<MapErrors>> rows(biases.size());
    if (map_count < 2) {
        return rows;
    }
    const std::int64_t units = ErrorSegments::units_of(inputs.rule.traits);
    const auto cells =
        count_error_buckets(cells_by_map(inputs.classes, maps, map_count), inputs, biases);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const ErrorBucket& cell : cells[i]) {
            rows[i].push_back(errors_of(cell, units));
        }
    }
    return rows;
}

} // namespace gnomon::analysis
