#include "reference_rt/stand_in.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::reference_rt {

using scene::Light;
using scene::LightType;
using scene::Ray;
using scene::Vec3d;
using scene::Vec3f;

namespace {

/// More than the stand-in's point may be off along its direction: its padding, and as much again.
constexpr double margin = 2 * box_padding;

/// Half the diagonal of the unit frame's box, with room.
constexpr double frame_radius = 1.75;

} // namespace

BoundedPoint unit_point(const Receiver& receiver, const UnitFrame& frame)
{
    const Ray& ray = receiver.camera_ray.ray;
    const Vec3d origin = frame.from_world(ray.origin);
    const Vec3d step = frame.scale() * receiver.t() * ray.direction;
    // Of t, of the product and of the quotient; of the difference and the sum.
    const double error = frame.scale() * largest(ray.direction) * receiver.t_error() +
                         4 * unit_roundoff * (largest(origin) + largest(step));
    const bool is_tight =
        receiver.camera_ray.is_tame && error >= 0 && error <= 0.25 * max_origin_error;
    if (is_tight && std::abs(receiver.delta.value) > receiver.delta.error()) {
        return {origin + step, error};
    }
    const Vec3d position = frame.scale() * exact_offset(receiver, frame.centre());
    return {position, 0x1p-49 * largest(position)};
}

CameraStandIn::CameraStandIn(const CameraRay& camera_ray, const UnitFrame& frame)
{
    const Ray& ray = camera_ray.ray;
    direction_ = normalised(ray.direction);
    const Vec3d eye = frame.from_world(ray.origin);
    const double length2 = glm::dot(direction_, direction_);
    const double t =
        std::max(0.0, -glm::dot(eye, direction_) / length2 - frame_radius / std::sqrt(length2));
    const double error = 4 * unit_roundoff * (largest(eye) + 2 * t);
    if (error <= 0.25 * max_origin_error) {
        origin_ = {eye + t * direction_, error};
        return;
    }
    // An eye so far away that doubles do not resolve the scene.
    const double world_t = t / frame.scale() * (largest(direction_) / largest(ray.direction));
    const Vec3d position = frame.scale() * exact_offset(ray, world_t, frame.centre());
    origin_ = {position, 0x1p-49 * largest(position)};
}

float CameraStandIn::t_beyond(const Vec3d& unit_point) const
{
    const double t =
        glm::dot(unit_point - origin_.position, direction_) / glm::dot(direction_, direction_);
    return static_cast<float>((1 + 0x1p-20) * t + margin);
}

FloatRay shadow_stand_in(const Vec3d& point, const Light& light, const UnitFrame& frame)
{
    if (light.type == LightType::directional) {
        return {Vec3f{point}, Vec3f{normalised(-light.direction)}, 0,
                std::numeric_limits<float>::infinity(), casters};
    }
    const Vec3d to_light = frame.from_world(light.position) - point;
    const double length = largest(to_light);
    if (length < 0x1p-60) { // the segment is all at P: any direction will do
        return {Vec3f{point}, Vec3f{1, 0, 0}, 0, static_cast<float>(margin), casters};
    }
    const Vec3d direction = normalised(to_light);
    // What lies beyond the light is rejected by its signs.
    const double t_far = 1.001 * length / largest(direction) + margin;
    return {Vec3f{point}, Vec3f{direction}, 0, static_cast<float>(t_far), casters};
}

} // namespace gnomon::reference_rt
