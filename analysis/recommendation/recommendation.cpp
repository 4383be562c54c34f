#include "analysis/recommendation/recommendation.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/recommendation/bias_valley.hpp"

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

RecommendedBias recommended_bias(const BiasInterval& valley, const BiasLengths& lengths)
{
    if (valley.lo <= 0) {
        return {0, Margin::not_needed};
    }
    const float spared = lengths.lengthened(valley.lo, margin_texels);
    const auto mean = static_cast<float>(std::sqrt(double{valley.lo} * double{valley.hi}));
    return spared <= mean ? RecommendedBias{spared, Margin::whole}
                          : RecommendedBias{mean, Margin::cut_short};
}

PastedBias pasted_near(const RecommendedBias& recommended, const BiasInterval& valley,
                       const BiasInterval& within, const scene::BiasSettings& settings,
                       const scene::LightFrustum& frustum)
{
    if (recommended.margin == Margin::within_limits) {
        return pasted_bias(recommended.bias, within, settings, frustum);
    }
    const float quarter = (recommended.bias - valley.lo) / 4;
    return pasted_bias(recommended.bias,
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
    const auto valley = find_valley(error_pieces(curve.lit(), curve.blocked()));
    if (!valley) {
        return std::nullopt;
    }
    const RecommendedBias recommended = recommended_bias(valley->run, lengths);
    const PastedBias pasted =
        pasted_near(recommended, valley->run, valley->run, settings, lengths.frustum);
    return Recommendation{lengths.of(recommended.bias),
                          lengths.of(valley->run.lo),
                          lengths.of(valley->run.hi),
                          outcome_of(curve.at(recommended.bias)),
                          pasted,
                          lengths.of(pasted.bias),
                          outcome_of(curve.at(pasted.bias)),
                          1,
                          recommended.margin};
}

} // namespace gnomon::analysis
