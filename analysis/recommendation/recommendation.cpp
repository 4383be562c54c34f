#include "analysis/recommendation/recommendation.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/recommendation/broad_minimum.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

Outcome outcome_of(const ErrorCounts& errors)
{
    return {errors,
            {static_cast<double>(errors.false_shadow), static_cast<double>(errors.false_lit), 0, 0},
            0};
}

} // namespace

const scene::LightFrustum& BiasLengths::told_in() const
{
    return read_map ? *read_map : frustum;
}

BiasLength BiasLengths::of(float bias) const
{
    const scene::LightFrustum& map = told_in();
    const double metres = bias_length_m(map, scale_there * double{bias}, light_distance_m);
    return {bias, metres, metres / map.texel_width_m(light_distance_m, resolution_texels)};
}

BiasLengths bias_lengths_in(const scene::View& view, int resolution_texels, double light_distance_m,
                            std::size_t map)
{
    BiasLengths lengths{view.first_map(), resolution_texels, light_distance_m};
    if (map > 0) {
        lengths.read_map = view.maps.at(map);
        lengths.scale_there = view.bias_scales.empty() ? 1.0 : double{view.bias_scales[map]};
    }
    return lengths;
}

float BiasLengths::lengthened(float bias, double texels) const
{
    const scene::LightFrustum& map = told_in();
    const double metres = bias_length_m(map, scale_there * double{bias}, light_distance_m) +
                          texels * map.texel_width_m(light_distance_m, resolution_texels);
    const double longer = bias_of_length(map, metres, light_distance_m) / scale_there;
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
