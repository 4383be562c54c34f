#pragma once

#include "scene/vec.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::scene {

enum class LightType : std::uint8_t {
    directional,
    spot,
    point, ///< shines in all directions
};

inline constexpr std::array light_types{LightType::directional, LightType::spot, LightType::point};

/// "directional", "spot", "point".
[[nodiscard]] std::string_view light_type_name(LightType type);
[[nodiscard]] std::optional<LightType> light_type_from_name(std::string_view name);

/// Whether its rays come from one point; else they are parallel.
[[nodiscard]] constexpr bool is_positional(LightType type)
{
    return type != LightType::directional;
}
[[nodiscard]] constexpr bool has_cone(LightType type)
{
    return type == LightType::spot;
}
[[nodiscard]] constexpr bool shines_all_round(LightType type)
{
    return type == LightType::point;
}

/// The sun over a place on the earth at a time.
struct SunSettings {
    double latitude_deg = 0;
    double longitude_deg = 0; ///< east of Greenwich
    std::string time;         ///< as `utc_time` reads it
};

/// The job's `[light]` table.
struct LightSettings {
    LightType type = LightType::directional;
    std::optional<Vec3d> direction; ///< in which the light travels; directional
    /// [m]; spot, point: required. directional: position of its camera
    std::optional<Vec3d> position;
    std::optional<Vec3d>
        target;           ///< [m]; spot: required. directional: gives the direction, with position
    double cone_deg = 60; ///< full opening angle, (0, 180); spot
    std::optional<SunSettings> sun; ///< instead of the direction (`with_direction`); directional
};

/// A light as exact input: every Vec3d is float32-representable.
struct Light {
    LightType type = LightType::directional;
    /// directional: direction of travel, not normalised. spot: axis a = float32(target) −
    /// float32(position). point: 0
    Vec3d direction{0.0};
    Vec3d position{0.0};         ///< spot, point: L [m]. directional: unused
    double cos_half_cone = -1.0; ///< spot: the double cos(cone/2)

    [[nodiscard]] bool has_position() const { return is_positional(type); }
    [[nodiscard]] bool has_cone() const { return scene::has_cone(type); }
    [[nodiscard]] bool shines_all_round() const { return scene::shines_all_round(type); }
    /// The vector from a point to the light, not normalised; −direction for a directional light.
    [[nodiscard]] Vec3d way_from(const Vec3d& point) const
    {
        return has_position() ? position - point : -direction;
    }
};

/// Rounds to float32 once.
/// @throws InputError  naming the key, if a vector is missing, zero, or position equals target.
[[nodiscard]] Light make_light(const LightSettings& settings);

} // namespace gnomon::scene
