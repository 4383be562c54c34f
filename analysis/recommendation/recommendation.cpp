#include "analysis/recommendation/recommendation.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/recommendation/bias_valley.hpp"

namespace gnomon::analysis {

namespace {

Outcome outcome_of(const ErrorCounts& errors)
{
    return {errors,
            {static_cast<double>(errors.false_shadow), static_cast<double>(errors.false_lit), 0, 0},
            0};
}

} // namespace

BiasLength BiasLengths::of(float bias) const
{
    const double metres = bias_length_m(frustum, double{bias}, light_distance_m);
    return {bias, metres, metres / frustum.texel_width_m(light_distance_m, resolution_texels)};
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
    const float middle = valley->middle();
    const PastedBias pasted = pasted_bias(middle, valley->run, settings, lengths.frustum);
    return Recommendation{lengths.of(middle),
                          lengths.of(valley->run.lo),
                          lengths.of(valley->run.hi),
                          outcome_of(curve.at(middle)),
                          pasted,
                          lengths.of(pasted.bias),
                          outcome_of(curve.at(pasted.bias)),
                          1};
}

} // namespace gnomon::analysis
