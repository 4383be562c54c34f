#include "scene/view/nearby_cameras.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gnomon::scene {

namespace {

constexpr double camera_cap_deg = 60;
constexpr double light_cap_deg = 30;

/// The van der Corput sequence in [0, 1): the digits of k, mirrored at the point.
double radical_inverse(std::uint32_t k, std::uint32_t base)
{
    double value = 0;
    double place = 1;
    for (; k > 0; k /= base) {
        place /= base;
        value += place * (k % base);
    }
    return value;
}

/// A direction evenly spread over the cap around the unit vector `axis`.
/// @param right, up  unit, square to it and to each other.
Vec3d in_cap(const Vec3d& axis, const Vec3d& right, const Vec3d& up, double cap_deg,
             std::uint32_t k)
{
    const double cosine = 1 - radical_inverse(k, 2) * (1 - std::cos(glm::radians(cap_deg)));
    const double sine = std::sqrt(1 - cosine * cosine);
    const double side_rad = 2 * std::numbers::pi * radical_inverse(k, 3);
    return cosine * axis + sine * (std::cos(side_rad) * right + std::sin(side_rad) * up);
}

} // namespace

CameraSettings nearby_camera(const CameraSettings& own, std::uint32_t k)
{
    const Camera camera = make_camera(own);
    const double factor = std::exp2(radical_inverse(k, 5) - 0.5);
    const Vec3d way = in_cap(-camera.forward, camera.right, camera.up, camera_cap_deg, k);
    CameraSettings nearby = own;
    nearby.eye = own.target + factor * glm::length(own.target - own.eye) * way;
    nearby.orthographic_height_m = factor * own.orthographic_height_m;
    return nearby;
}

LightSettings nearby_light(const LightSettings& own, std::uint32_t k)
{
    if (shines_all_round(own.type)) {
        throw std::invalid_argument{"nearby_light: own is a point light, which has no direction"};
    }
    const Vec3d axis = glm::normalize(make_light(own).direction);
    const bool is_vertical = std::abs(axis.x) < 1e-3 && std::abs(axis.z) < 1e-3;
    const Vec3d right =
        glm::normalize(glm::cross(axis, is_vertical ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}));
    const Vec3d turned = in_cap(axis, right, glm::cross(right, axis), light_cap_deg, k);
    LightSettings nearby = own;
    if (!own.direction) {
        nearby.position = *own.target - glm::length(*own.target - *own.position) * turned;
    } else {
        nearby.direction = turned;
    }
    return nearby;
}

} // namespace gnomon::scene
