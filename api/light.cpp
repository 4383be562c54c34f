#include "api/light.hpp"

namespace gnomon::api {

scene::Light make_light_of_doubles(const scene::LightSettings& settings)
{
    scene::Light light = scene::make_light(settings);
    if (light.has_position()) {
        light.position = *settings.position;
    }
    if (settings.direction) {
        light.direction = *settings.direction;
    } else if (settings.target) {
        light.direction = *settings.target - settings.position.value_or(scene::Vec3d{0.0});
    }
    return light;
}

} // namespace gnomon::api
