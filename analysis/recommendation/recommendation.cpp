#include "analysis/recommendation/recommendation.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/recommendation/broad_minimum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon::analysis {

RoundedBias rounded_bias(float middle, const BiasInterval& run, const scene::BiasSettings& settings,
                         const scene::LightFrustum& frustum)
{
    const scene::BiasUnit& unit = scene::bias_unit_of(settings);
    const double per_depth = unit.per_depth(frustum);
    constexpr int enough_digits = 17; // enough to read back every double
    for (int digits = 2; digits <= enough_digits; ++digits) {
        const std::string text = fmt::format("{:.{}g}", double{middle} * per_depth, digits);
        const double value = std::stod(text);
        const auto bias = static_cast<float>(value / per_depth); // rounded as in `resolve_bias`
        const bool is_bias = bias == 0 || std::isnormal(bias);
        if (is_bias && bias >= run.lo && bias <= run.hi) {
            return {fmt::format("{} = {}", unit.key, text), bias, &unit,
                    unit.is_depth() ? double{bias} : value};
        }
    }
    return {fmt::format("{} = {}", scene::bias_in_depth.key, middle), middle, &scene::bias_in_depth,
            double{middle}};
}

namespace {

Outcome outcome_of(const ErrorCounts& errors)
{
    return {errors,
            {static_cast<double>(errors.false_shadow), static_cast<double>(errors.false_lit), 0, 0},
            0};
}

} // namespace

const scene::LightFrustum& BiasLengths::conversion_map() const
{
    return read_map ? *read_map : frustum;
}

BiasLength BiasLengths::of(float bias) const
{
    const scene::LightFrustum& map = conversion_map();
    const double metres = bias_length_m(map, read_map_scale * double{bias}, light_distance_m);
    return {bias, metres, metres / map.texel_width_m(light_distance_m, resolution_texels)};
}

BiasLengths bias_lengths_in(const scene::View& view, int resolution_texels, double light_distance_m,
                            std::size_t map)
{
    BiasLengths lengths{view.first_map(), resolution_texels, light_distance_m};
    if (map > 0) {
        lengths.read_map = view.maps.at(map);
        lengths.read_map_scale = view.bias_scales.empty() ? 1.0 : double{view.bias_scales[map]};
    }
    return lengths;
}

float BiasLengths::lengthened(float bias, double texels) const
{
    const scene::LightFrustum& map = conversion_map();
    const double metres = bias_length_m(map, read_map_scale * double{bias}, light_distance_m) +
                          texels * map.texel_width_m(light_distance_m, resolution_texels);
    const double longer = bias_of_length(map, metres, light_distance_m) / read_map_scale;
    return static_cast<float>(std::min(longer, std::max(1.0, double{bias})));
}

RecommendedBias recommended_bias(const BiasInterval& broad_minimum, const BiasLengths& lengths)
{
    if (broad_minimum.lo <= 0) {
        return {0, Margin::not_needed};
    }
    const float spared = lengths.lengthened(broad_minimum.lo, margin_texels);
    const auto mean =
        static_cast<float>(std::sqrt(double{broad_minimum.lo} * double{broad_minimum.hi}));
    return spared <= mean ? RecommendedBias{spared, Margin::whole}
                          : RecommendedBias{mean, Margin::cut_short};
}

RoundedBias rounded_near(const RecommendedBias& recommended, const BiasInterval& broad_minimum,
                         const BiasInterval& within, const scene::BiasSettings& settings,
                         const scene::LightFrustum& frustum)
{
    if (recommended.margin == Margin::within_limits) {
        return rounded_bias(recommended.bias, within, settings, frustum);
    }
    const float quarter = (recommended.bias - broad_minimum.lo) / 4;
    return rounded_bias(recommended.bias,
                        {std::max(within.lo, recommended.bias - quarter),
                         std::min(within.hi, recommended.bias + quarter)},
                        settings, frustum);
}

std::optional<Recommendation> recommend_by_count(const BiasCurve& curve, const BiasLengths& lengths,
                                                 const scene::BiasSettings& settings)
{
    if (curve.lit().empty()) {
        return std::nullopt;
    }
    const auto broad_minimum = find_broad_minimum(error_pieces(curve.lit(), curve.blocked()));
    if (!broad_minimum) {
        return std::nullopt;
    }
    const RecommendedBias recommended = recommended_bias(broad_minimum->run, lengths);
    const RoundedBias rounded = rounded_near(recommended, broad_minimum->run, broad_minimum->run,
                                             settings, lengths.frustum);
    return Recommendation{lengths.of(recommended.bias),
                          lengths.of(broad_minimum->run.lo),
                          lengths.of(broad_minimum->run.hi),
                          outcome_of(curve.at(recommended.bias)),
                          rounded,
                          lengths.of(rounded.bias),
                          outcome_of(curve.at(rounded.bias)),
                          1,
                          recommended.margin};
}

} // namespace gnomon::analysis
