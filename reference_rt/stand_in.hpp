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
    scene::Vec3d position;
    double error = 0;
};
/// P. Precondition: δ is not 0.
[[nodiscard]] BoundedPoint unit_point(const Receiver& receiver, const UnitFrame& frame);

/// A camera ray that begins where the exact one enters the scene's surroundings.
class CameraStandIn {
public:
    CameraStandIn() = default;
    CameraStandIn(const CameraRay& ray, const UnitFrame& frame);

    [[nodiscard]] const BoundedPoint& origin() const { return origin_; }
    [[nodiscard]] const scene::Vec3d& direction() const { return direction_; }
    /// A distance along the float ray that is beyond the given point of the exact one.
    [[nodiscard]] float t_beyond(const scene::Vec3d& unit_point) const;
    [[nodiscard]] FloatRay ray(float t_far = std::numeric_limits<float>::infinity()) const
    {
        return {scene::Vec3f{origin_.position}, scene::Vec3f{direction_}, 0, t_far, receivers};
    }

private:
    BoundedPoint origin_;
    scene::Vec3d direction_{};
};

/// The stand-in of the open segment from `point` to the light.
[[nodiscard]] FloatRay shadow_stand_in(const scene::Vec3d& point, const scene::Light& light,
                                       const UnitFrame& frame);

} // namespace gnomon::reference_rt
