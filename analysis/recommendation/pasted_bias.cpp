#include "analysis/recommendation/pasted_bias.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

namespace gnomon::analysis {

PastedBias pasted_bias(float middle, const BiasInterval& run, const scene::BiasSettings& settings,
                       const scene::LightFrustum& frustum)
{
    const bool in_metres = settings.constant_m.has_value();
    const double depth_per_unit = in_metres ? 1 / frustum.range_m() : 1;
    const char* const key = in_metres ? "bias.constant_m" : "bias.constant";
    constexpr int enough_digits = 17; // every double reads back from as many
    for (int digits = 2; digits <= enough_digits; ++digits) {
        const std::string text = fmt::format("{:.{}g}", double{middle} / depth_per_unit, digits);
        // As `resolve_bias` rounds it.
        const auto bias = in_metres ? static_cast<float>(std::stod(text) / frustum.range_m())
                                    : static_cast<float>(std::stod(text));
        const bool is_bias = bias == 0 || std::isnormal(bias);
        if (is_bias && bias >= run.lo && bias <= run.hi) {
            return {fmt::format("{} = {}", key, text), bias,
                    in_metres ? std::optional{std::stod(text)} : std::nullopt};
        }
    }
    return {fmt::format("bias.constant = {}", middle), middle};
}

} // namespace gnomon::analysis
