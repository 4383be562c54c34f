#include "analysis/limits/slope_curves.hpp"

#include "analysis/bias/bias_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace gnomon::analysis {

double depth_per_footprint(const scene::LightFrustum& frustum, int resolution_texels,
                           int footprint_texels, double light_distance_m)
{
    return footprint_texels * frustum.texel_width_m(light_distance_m, resolution_texels) *
           depth_per_metre(frustum, light_distance_m);
}

int footprint_width_texels(const methods::LookupTraits& traits, const scene::LightFrustum& frustum,
                           int resolution_texels, double light_distance_m)
{
    const methods::ScatteredTaps& taps = traits.taps;
    if (!taps.is_in_metres) {
        return traits.width_texels;
    }
    const double radius = taps.radius / frustum.texel_width_m(light_distance_m, resolution_texels);
    return methods::width_of_radius(std::min(radius, methods::largest_radius_texels));
}

std::vector<float> default_slopes(double per_footprint)
{
    constexpr std::array<double, 5> multiples{0.25, 0.5, 1.0, 2.0, 4.0};
    std::vector<float> slopes{0.0F};
    for (const double multiple : multiples) {
        const std::string digits = fmt::format("{:.3g}", multiple * per_footprint);
        const auto slope = static_cast<float>(std::stod(digits));
        if (!(slope > 0.0F) || !std::isnormal(slope)) {
            throw std::invalid_argument(fmt::format(
                "default_slopes: per_footprint: {} does not give normal, positive float32 slopes",
                per_footprint));
        }
        slopes.push_back(slope);
    }
    return slopes;
}

SlopeCurve slope_curve(const SlopeInputs& inputs, float slope)
{
    LookupRule rule = inputs.rule;
    rule.slope = slope;
    scene::Image<float> criticals = inputs.find_critical_biases
                                        ? inputs.find_critical_biases(slope)
                                        : critical_biases(inputs.samples, rule);
    BiasCurve curve{criticals, inputs.classes};
    const BestBiases best = find_best_biases(curve);
    std::optional<TapCriticals> taps;
    if (inputs.lookup != nullptr) {
        taps.emplace(*inputs.lookup, *inputs.map_depths, rule);
    }
    const auto acne_free = [&](std::span<const std::uint64_t> allowed_pixels) {
        return find_acne_free({inputs.classes, criticals, inputs.causes, taps ? &*taps : nullptr,
                               rule.traits.is_made_of_taps() && rule.traits.has_fractions(),
                               rule.traits.weighs_taps()},
                              allowed_pixels);
    };
    const BiasBounds bounds =
        find_bias_bounds(curve, criticals, inputs.classes, acne_free, inputs.forgive);
    return {slope, std::move(criticals), std::move(curve), best, bounds};
}

} // namespace gnomon::analysis
