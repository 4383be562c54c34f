#include "analysis/recommendation/rounded_bias.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace gnomon::analysis {

RoundedBias rounded_bias(float middle, const BiasInterval& run, const scene::BiasSettings& settings,
                         const scene::LightFrustum& frustum)
{
    const scene::BiasUnit& unit = scene::bias_unit_of(settings);
    const double per_depth = unit.per_depth(frustum);
    constexpr int enough_digits = 17; // every double reads back from as many
    for (int digits = 2; digits <= enough_digits; ++digits) {
        const std::string text = fmt::format("{:.{}g}", double{middle} * per_depth, digits);
        const double value = std::stod(text);
        const auto bias = static_cast<float>(value / per_depth); // as `resolve_bias` rounds it
        const bool is_bias = bias == 0 || std::isnormal(bias);
        if (is_bias && bias >= run.lo && bias <= run.hi) {
            return {fmt::format("{} = {}", unit.key, text), bias, &unit,
                    unit.is_depth() ? double{bias} : value};
        }
    }
    return {fmt::format("{} = {}", scene::bias_in_depth.key, middle), middle, &scene::bias_in_depth,
            double{middle}};
}

} // namespace gnomon::analysis
