#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/traversal/float_line_filter.hpp"
#include "reference_rt/traversal/lane_rays.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "reference_rt/traversal/unit_frame.hpp"
#include "scene/light/light.hpp"

#include <limits>

/// Float rays in the unit frame that stand in for exact ones: the proxy ray hits the padded box of
/// every triangle that the exact ray or segment touches (see `box_padding`).
namespace gnomon::reference_rt {

/// Whether `box_padding` allows for the error with a margin; false for NaN.
[[nodiscard]] inline bool is_resolved(double error)
{
    return error <= 0.25 * max_origin_error;
}

/// P in the unit frame within a relative 2^-49, for points that doubles do not resolve.
[[nodiscard]] IntervalPoint exact_unit_point(const Receiver& receiver, const UnitFrame& frame);

/// E + t d in the unit frame; its error may be large.
[[nodiscard]] inline IntervalPoint point_along(const scene::Ray& ray, double t, double t_error,
                                               const UnitFrame& frame)
{
    const scene::Vec3d origin = frame.from_world(ray.origin);
    const scene::Vec3d step = frame.scale() * t * ray.direction;
    // The error of t, and the roundings of product, difference and sum.
    const double error = frame.scale() * largest(ray.direction) * t_error +
                         4 * unit_roundoff * (largest(origin) + largest(step));
    return {origin + step, error};
}

/// P in the unit frame. Precondition: δ is not 0.
[[nodiscard]] inline IntervalPoint unit_point(const Receiver& receiver, const UnitFrame& frame)
{
    const IntervalPoint point = point_along(receiver.ray(), receiver.t, receiver.t_error, frame);
    return is_resolved(point.error) ? point : exact_unit_point(receiver, frame);
}

/// Computes a packet's points P in doubles; errors may be large, infinite or NaN.
void find_unit_points(const LaneRays& rays, const LaneHits& hits, const UnitFrame& frame,
                      LanePositions& points);

/// How far a proxy ray extends beyond a hit: twice the padding, as its direction has length 1 and
/// its point may lag behind.
inline constexpr double hit_margin = 2 * box_padding;
/// The end of a proxy ray with a hit at t, in unit-frame lengths.
[[nodiscard]] inline float end_beyond(double t)
{
    return static_cast<float>((1 + 0x1p-20) * t + hit_margin);
}
/// Whether the margin covers this error of t; false for NaN.
[[nodiscard]] inline bool is_end_known(double t_error)
{
    return t_error <= 0.25 * hit_margin;
}

/// Error bound of a proxy ray's origin that equals the ray's origin.
inline constexpr double near_origin_error = 2 * unit_roundoff * farthest_origin;

/// A camera or texel ray in the unit frame that starts near the scene. Its direction is the exact
/// ray's, with length about 1 or more.
class CameraProxyRays {
public:
    CameraProxyRays(const CameraRay& camera_ray, const UnitFrame& frame)
        : frame_{frame},
          direction_{camera_ray.ray.direction},
          origin_{frame.from_world(camera_ray.ray.origin), 0}
    {
        if (largest(origin_.position) <= farthest_origin) {
            origin_.error = near_origin_error;
        } else {
            begin_near_scene(camera_ray.ray);
        }
    }

    [[nodiscard]] const IntervalPoint& origin() const { return origin_; }
    /// A distance along the float ray beyond the hit; infinite if the hit is too uncertain.
    [[nodiscard]] float t_beyond(const Receiver& hit) const { return t_beyond(hit.t, hit.t_error); }
    [[nodiscard]] float t_beyond(double t, double t_error) const
    {
        return is_end_known(frame_.scale() * t_error) && t_begin_ <= farthest_resolved
                   ? end_beyond(frame_.scale() * t - t_begin_)
                   : std::numeric_limits<float>::infinity();
    }
    [[nodiscard]] FloatRay ray(float t_far, RayMask mask = receivers) const
    {
        return {scene::Vec3f{origin_.position}, scene::Vec3f{direction_}, 0, t_far, mask};
    }

private:
    void begin_near_scene(const scene::Ray& ray);

    /// Beyond this, doubles do not resolve the scene.
    static constexpr double farthest_resolved = 0x1p24;

    const UnitFrame& frame_;
    scene::Vec3d direction_;
    IntervalPoint origin_;
    double t_begin_ = 0;
};

/// The proxy rays of a packet's camera rays. Those of lanes in `seen` end beyond their hits, the
/// others are infinite.
/// @param origins  start points of the rays.
void proxy_rays_for(const LaneRays& rays, const LaneHits& hits, LaneBits seen,
                    const UnitFrame& frame, FloatRays& proxy_rays, LanePositions& origins);

/// The proxy ray of the open segment from `point` to the light.
class ShadowProxyRays {
public:
    ShadowProxyRays(const scene::Light& light, const UnitFrame& frame);

    /// Writes the proxy rays of the given lanes; the others stay unchanged.
    void from(const LanePositions& points, LaneBits lanes, FloatRays& rays) const;

private:
    [[nodiscard]] FloatRay ray_to_positional(const scene::Vec3d& point) const;

    bool has_position_;
    scene::Vec3f to_directional_{};
    scene::Vec3d positional_{};
};

} // namespace gnomon::reference_rt
