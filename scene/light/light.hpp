#pragma once

#include "scene/vec.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace gnomon::scene {

enum class LightType : std::uint8_t {
    directional,
    spot,
    point, ///< shines everywhere alike: its shadow maps are the faces of a cube
};

/// "directional", "spot", "point".
[[nodiscard]] std::string_view light_type_name(LightType type);

/// The job's `[light]` table.
struct LightSettings {
    LightType type = LightType::directional;
    std::optional<Vec3d> direction; ///< the way the light travels; directional
    /// [m]; spot, point: required. directional: where its camera stands
    std::optional<Vec3d> position;
    std::optional<Vec3d> target; ///< [m]; spot: required. directional: with position, the direction
    double cone_deg = 60;        ///< full opening angle, (0, 180); spot
};

/// A light in the form in which it is exact input (every Vec3d is float32-representable).
struct Light {
    LightType type = LightType::directional;
    /// directional: way of travel, not normalised. spot: axis a = float32(target) −
    /// float32(position). point: 0
    Vec3d direction{0.0};
    Vec3d position{0.0};         ///< spot, point: L [m]. directional: unused
    double cos_half_cone = -1.0; ///< spot: the double cos(cone/2)

    /// Whether its rays come from one point.
    [[nodiscard]] bool has_position() const { return type != LightType::directional; }
};

/// Rounds to float32 once.
/// @throws InputError  naming the key, if a vector is missing, zero, or position equals target.
[[nodiscard]] Light make_light(const LightSettings& settings);

} // namespace gnomon::scene
