#include "scene/light/light_camera.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon::scene {
namespace {

/// Cosine and sine of an angle; of quarter turns exactly.
Vec2d turn_by(double angle_deg)
{
    const double quarters = angle_deg / 90;
    if (quarters != std::round(quarters)) {
        return {std::cos(glm::radians(angle_deg)), std::sin(glm::radians(angle_deg))};
    }
    constexpr std::array<std::array<double, 2>, 4> turns{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const auto& turn = turns.at(static_cast<std::size_t>(static_cast<int>(quarters) & 3));
    return {turn[0], turn[1]};
}

void set_axes(LightFrustum& frustum, const Vec3d& direction, double roll_deg)
{
    frustum.forward = glm::normalize(direction);
    const Vec3d world_up{0, 1, 0};
    const bool vertical = glm::length(glm::cross(frustum.forward, world_up)) < 1e-3;
    const Vec3d hint = vertical ? Vec3d{0, 0, 1} : world_up;
    const Vec3d right = glm::normalize(glm::cross(frustum.forward, hint));
    const Vec3d up = glm::cross(right, frustum.forward);
    const Vec2d roll = turn_by(roll_deg);
    frustum.right = roll.x * right + roll.y * up;
    frustum.up = roll.x * up - roll.y * right;
}

Vec3d camera_position(const LightSettings& settings, const Light& light, const Box& box)
{
    if (light.has_cone()) {
        return light.position;
    }
    return settings.position ? rounded_to_float32(*settings.position) : box.centre();
}

} // namespace

LightFrustum place_light_camera(const FrustumSettings& settings,
                                const LightSettings& light_settings, const Light& light,
                                const Box& box)
{
    LightFrustum frustum;
    frustum.projection = light.has_cone() ? Projection::perspective : Projection::orthographic;
    frustum.content = settings.content;
    frustum.reversed = settings.reversed;
    frustum.clip_range = clip_range_of(settings);
    frustum.origin = camera_position(light_settings, light, box);
    set_axes(frustum, light.direction, settings.roll_deg);
    return frustum;
}

Vec3d in_light_view(const LightFrustum& frustum, const Vec3d& point)
{
    const Vec3d q = point - frustum.origin;
    return {glm::dot(frustum.right, q), glm::dot(frustum.up, q), glm::dot(frustum.forward, q)};
}

} // namespace gnomon::scene
