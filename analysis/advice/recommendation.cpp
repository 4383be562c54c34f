#include "analysis/advice/recommendation.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/bias/bias_valley.hpp"

namespace gnomon::analysis {

namespace {

Outcome outcome_of(const ErrorCounts& errors)
{
    return {errors,
            {static_cast<double>(errors.false_shadow), static_cast<double>(errors.false_lit), 0, 0},
            0};
}

} // namespace

BiasLength BiasPlace::length_of(float bias) const
{
    const double metres = bias_length_m(frustum, double{bias}, light_distance_m);
    return {bias, metres, metres / frustum.texel_width_m(light_distance_m, resolution_texels)};
}

std::optional<Recommendation> recommend_by_count(const BiasCurve& curve, const BiasPlace& place,
                                                 const scene::BiasSettings& settings)
{
    if (curve.lit().empty()) {
        return std::nullopt;
    }
    const auto valley = find_valley(error_pieces(curve.lit(), curve.blocked()));
    if (!valley) {
        return std::nullopt;
    }
    const float middle = valley->middle();
    const PastedBias pasted = pasted_bias(middle, valley->run, settings, place.frustum);
    return Recommendation{place.length_of(middle),
                          place.length_of(valley->run.lo),
                          place.length_of(valley->run.hi),
                          outcome_of(curve.at(middle)),
                          pasted,
                          place.length_of(pasted.bias),
                          outcome_of(curve.at(pasted.bias)),
                          1};
}

} // namespace gnomon::analysis
