#pragma once

#include "reference_rt/packet.hpp"
#include "reference_rt/pencil.hpp"
#include "reference_rt/predicates.hpp"
#include "reference_rt/unit_frame.hpp"
#include "scene/light.hpp"

#include <limits>

/// Float rays in the unit frame that stand in for exact ones: a triangle that the exact ray or
/// segment touches has its padded box hit by the stand-in (see `box_padding`).
namespace gnomon::reference_rt {

/// A point in the unit frame, and what each component may be off.
struct BoundedPoint {
    scene::Vec3d position{};
    double error = 0;
};

/// P, when doubles do not resolve it: to within 2^-49 of its size.
[[nodiscard]] BoundedPoint exact_unit_point(const Receiver& receiver, const UnitFrame& frame);

/// P. Precondition: δ is not 0.
[[nodiscard]] inline BoundedPoint unit_point(const Receiver& receiver, const UnitFrame& frame)
{
    const scene::Ray& ray = receiver.ray();
    const scene::Vec3d origin = frame.from_world(ray.origin);
    const scene::Vec3d step = frame.scale() * receiver.t * ray.direction;
    // Of t; of the product, of the difference and of the sum.
    const double error = frame.scale() * largest(ray.direction) * receiver.t_error +
                         4 * unit_roundoff * (largest(origin) + largest(step));
    if (error <= 0.25 * max_origin_error) {
        return {origin + step, error};
    }
    return exact_unit_point(receiver, frame);
}

/// A camera's or a texel's ray in the unit frame that begins near the scene. Its direction is the
/// exact one's, which is about 1 long or longer.
class CameraStandIn {
public:
    CameraStandIn(const CameraRay& camera_ray, const UnitFrame& frame)
        : frame_{frame},
          direction_{camera_ray.ray.direction},
          origin_{frame.from_world(camera_ray.ray.origin), 0}
    {
        if (largest(origin_.position) <= farthest_origin) {
            origin_.error = 2 * unit_roundoff * farthest_origin;
        } else {
            begin_near_scene(camera_ray.ray);
        }
    }

    [[nodiscard]] const BoundedPoint& origin() const { return origin_; }
    /// A distance along the float ray beyond the hit; may be infinite.
    [[nodiscard]] float t_beyond(const Receiver& hit) const
    {
        // Twice the padding, as the direction is 1 long: the stand-in's point may lag behind.
        constexpr double margin = 2 * box_padding;
        const double t = frame_.scale() * hit.t - t_begin_;
        const double error = frame_.scale() * hit.t_error;
        return error <= 0.25 * margin && t_begin_ <= farthest_resolved
                   ? static_cast<float>((1 + 0x1p-20) * t + margin)
                   : std::numeric_limits<float>::infinity();
    }
    [[nodiscard]] FloatRay ray(float t_far, RayMask mask = receivers) const
    {
        return {scene::Vec3f{origin_.position}, scene::Vec3f{direction_}, 0, t_far, mask};
    }

private:
    void begin_near_scene(const scene::Ray& ray);

    /// Beyond this doubles do not resolve the scene.
    static constexpr double farthest_resolved = 0x1p24;

    const UnitFrame& frame_;
    scene::Vec3d direction_;
    BoundedPoint origin_;
    double t_begin_ = 0;
};

/// The stand-in of the open segment from `point` to the light.
class ShadowStandIn {
public:
    ShadowStandIn(const scene::Light& light, const UnitFrame& frame);

    [[nodiscard]] FloatRay ray(const scene::Vec3d& point) const
    {
        return is_sun_ ? FloatRay{scene::Vec3f{point}, to_sun_, 0,
                                  std::numeric_limits<float>::infinity(), casters}
                       : ray_to_lamp(point);
    }

private:
    [[nodiscard]] FloatRay ray_to_lamp(const scene::Vec3d& point) const;

    bool is_sun_;
    scene::Vec3f to_sun_{};
    scene::Vec3d lamp_{};
};

} // namespace gnomon::reference_rt
