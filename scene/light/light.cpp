#include "scene/light/light.hpp"

#include "scene/error.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::scene {
namespace {

bool is_zero(const Vec3d& v)
{
    return v == Vec3d{0.0};
}

Light make_spot(const LightSettings& settings)
{
    if (!settings.position || !settings.target) {
        throw InputError("light.type = \"spot\" needs light.position and light.target");
    }
    Light light;
    light.type = LightType::spot;
    light.position = rounded_to_float32(*settings.position);
    light.direction = rounded_to_float32(*settings.target) - light.position;
    if (is_zero(light.direction)) {
        throw InputError("light.position equals light.target: move one of them");
    }
    light.cos_half_cone = std::cos(0.5 * glm::radians(settings.cone_deg));
    return light;
}

Light make_point(const LightSettings& settings)
{
    if (!settings.position) {
        throw InputError("light.type = \"point\" needs light.position");
    }
    Light light;
    light.type = LightType::point;
    light.position = rounded_to_float32(*settings.position);
    return light;
}

Light make_directional(const LightSettings& settings)
{
    Light light;
    if (settings.direction) {
        light.direction = rounded_to_float32(*settings.direction);
    } else if (settings.position && settings.target) {
        light.direction = rounded_to_float32(*settings.target - *settings.position);
    } else {
        throw InputError("light.type = \"directional\" needs light.direction, or light.position "
                         "and light.target");
    }
    if (is_zero(light.direction)) {
        throw InputError("light.direction is zero: give the direction in which the light travels");
    }
    return light;
}

} // namespace

std::string_view light_type_name(LightType type)
{
    switch (type) {
    case LightType::spot:
        return "spot";
    case LightType::point:
        return "point";
    case LightType::directional:
        break;
    }
    return "directional";
}

std::optional<LightType> light_type_from_name(std::string_view name)
{
    const auto found = std::ranges::find(light_types, name, light_type_name);
    return found == light_types.end() ? std::nullopt : std::optional{*found};
}

Light make_light(const LightSettings& settings)
{
    switch (settings.type) {
    case LightType::spot:
        return make_spot(settings);
    case LightType::point:
        return make_point(settings);
    case LightType::directional:
        break;
    }
    return make_directional(settings);
}

} // namespace gnomon::scene
