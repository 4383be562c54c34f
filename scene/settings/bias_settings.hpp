#pragma once

#include "scene/light/frustum.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace gnomon::scene {

struct BiasSettings {
    double constant = 0;                   ///< depth units [0,1]; without one in another unit
    std::optional<double> constant_m = {}; ///< metres along a directional light's axis
    double slope = 0;                      ///< depth units per unit of tan θ
    double normal_texels = 0;              ///< normal offset, in texel widths at P
};

/// What a job may give its constant bias in. A job has one: in depth units, or in a unit that is
/// linear in the distance along a directional light's axis.
struct BiasUnit {
    std::string_view key;
    std::string_view name;    ///< "metres"
    std::string_view symbol;  ///< the key's own unit, "m"
    std::string_view meaning; ///< of the key, as in `Key::description`
    std::string_view default_text;
    std::string_view example;
    double largest = 0;                           ///< the largest absolute value of the key
    std::optional<double> BiasSettings::*member;  ///< nullptr: `constant`
    double (*per_depth)(const LightFrustum& map); ///< what a depth unit is
    std::string_view shader_per_depth;            ///< the same in a shader with cascades

    [[nodiscard]] constexpr bool is_depth() const { return member == nullptr; }
};

/// Who writes, reads, converts or tells a constant bias goes by these rows.
inline constexpr auto bias_units = std::to_array<BiasUnit>({
    {"bias.constant", "depth units", "depth units", "constant bias, {unit}; or constant_m instead",
     "0", "", 1, nullptr, [](const LightFrustum& /*map*/) { return 1.0; }, ""},
    {"bias.constant_m", "metres", "m",
     "constant bias [{unit}] along a directional light's axis, in place of constant", "", "0.01",
     1e15, &BiasSettings::constant_m, [](const LightFrustum& map) { return map.range_m(); },
     "(far[cascade] - near[cascade])"},
});
inline constexpr const BiasUnit& bias_in_depth = bias_units[0];
inline constexpr const BiasUnit& bias_in_metres = bias_units[1];

/// True for the keys of a constant bias, whose every value the bias curve answers.
[[nodiscard]] constexpr bool is_constant_bias(std::string_view key)
{
    return std::ranges::find(bias_units, key, &BiasUnit::key) != bias_units.end();
}

/// The unit of the constant bias.
[[nodiscard]] inline const BiasUnit& bias_unit_of(const BiasSettings& settings)
{
    const auto found = std::ranges::find_if(bias_units, [&](const BiasUnit& unit) {
        return !unit.is_depth() && (settings.*unit.member).has_value();
    });
    return found == bias_units.end() ? bias_in_depth : *found;
}

/// The constant bias in its unit.
[[nodiscard]] inline double constant_in_unit(const BiasSettings& settings)
{
    const BiasUnit& unit = bias_unit_of(settings);
    return unit.is_depth() ? settings.constant : *(settings.*unit.member);
}

/// Puts a constant bias in place of what the settings have, in whatever unit.
inline void set_constant(BiasSettings& settings, const BiasUnit& unit, double value)
{
    for (const BiasUnit& other : bias_units) {
        if (!other.is_depth()) {
            (settings.*other.member).reset();
        }
    }
    settings.constant = unit.is_depth() ? value : 0;
    if (!unit.is_depth()) {
        settings.*unit.member = value;
    }
}

} // namespace gnomon::scene
