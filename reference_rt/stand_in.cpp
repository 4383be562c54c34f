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

BoundedPoint exact_unit_point(const Receiver& receiver, const UnitFrame& frame)
{
    const Vec3d position = frame.scale() * exact_offset(receiver, frame.centre());
    return {position, 0x1p-49 * largest(position)};
}

void CameraStandIn::begin_near_scene(const Ray& ray)
{
    // Two and a half before the point nearest to the frame's origin, whose box reaches √3 far.
    const double length2 = glm::dot(direction_, direction_);
    t_begin_ =
        std::max(0.0, -glm::dot(origin_.position, direction_) / length2 - 2.5 / std::sqrt(length2));
    origin_.error =
        4 * unit_roundoff * (largest(origin_.position) + t_begin_ * largest(direction_));
    if (origin_.error <= 0.25 * max_origin_error) {
        origin_.position += t_begin_ * direction_;
        return;
    }
    origin_.position =
        frame_.scale() * exact_offset(ray, t_begin_ / frame_.scale(), frame_.centre());
    origin_.error = 0x1p-49 * largest(origin_.position);
}

ShadowStandIn::ShadowStandIn(const Light& light, const UnitFrame& frame)
    : is_sun_{light.type == LightType::directional}
{
    if (is_sun_) {
        to_sun_ = Vec3f{normalised(-light.direction)};
    } else {
        lamp_ = frame.from_world(light.position);
    }
}

FloatRay ShadowStandIn::ray_to_lamp(const Vec3d& point) const
{
    const Vec3d to_light = lamp_ - point;
    const double length = largest(to_light);
    if (length < 0x1p-60) { // the segment is all at P: any direction will do
        return {Vec3f{point}, Vec3f{1, 0, 0}, 0, static_cast<float>(box_padding), casters};
    }
    const Vec3d direction = normalised(to_light);
    // What lies beyond the light is rejected by its signs.
    const double t_far = 1.001 * length / largest(direction) + box_padding;
    return {Vec3f{point}, Vec3f{direction}, 0, static_cast<float>(t_far), casters};
}

} // namespace gnomon::reference_rt
