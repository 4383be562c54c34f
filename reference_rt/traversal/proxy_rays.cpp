#include "reference_rt/traversal/proxy_rays.hpp"

#include "scene/infinity.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::reference_rt {

using scene::infinity;
using scene::Light;
using scene::LightType;
using scene::Ray;
using scene::Vec3d;
using scene::Vec3f;

namespace {

} // namespace

IntervalPoint exact_unit_point(const Receiver& receiver, const UnitFrame& frame)
{
    const Vec3d position = frame.scale() * exact_offset(receiver, frame.centre());
    return {position, 0x1p-49 * largest(position)};
}

GNOMON_WIDEST_VECTORS
void find_unit_points(const LaneRays& rays, const LaneHits& hits, const UnitFrame& frame_in,
                      LanePositions& points)
{
    const UnitFrame frame = frame_in; // a copy that cannot alias the points
    for (std::size_t i = 0; i < packet_size; ++i) {
        const IntervalPoint point =
            point_along({{rays.origin.x[i], rays.origin.y[i], rays.origin.z[i]},
                         {rays.direction.x[i], rays.direction.y[i], rays.direction.z[i]}},
                        hits.t[i], hits.t_error[i], frame);
        points.set(i, point);
    }
}

namespace {

/// As `proxy_rays_for`, for rays that start near the scene.
/// @return  The lanes whose rays start farther away.
GNOMON_WIDEST_VECTORS
LaneBits proxy_near_scene(const LaneRays& rays, const LaneHits& hits, LaneBits seen,
                          const UnitFrame& frame_in, FloatRays& proxy_rays, LanePositions& origins)
{
    const UnitFrame frame = frame_in;
    Lanes<int> is_far;
    for (std::size_t i = 0; i < packet_size; ++i) {
        const Vec3d origin =
            frame.from_world({rays.origin.x[i], rays.origin.y[i], rays.origin.z[i]});
        is_far[i] = static_cast<int>(largest(origin) > farthest_origin);
        origins.set(i, {origin, near_origin_error});
        proxy_rays.origin_x[i] = static_cast<float>(origin.x);
        proxy_rays.origin_y[i] = static_cast<float>(origin.y);
        proxy_rays.origin_z[i] = static_cast<float>(origin.z);
        proxy_rays.direction_x[i] = static_cast<float>(rays.direction.x[i]);
        proxy_rays.direction_y[i] = static_cast<float>(rays.direction.y[i]);
        proxy_rays.direction_z[i] = static_cast<float>(rays.direction.z[i]);
    }
    Lanes<float> end;
    Lanes<int> has_end;
    for (std::size_t i = 0; i < packet_size; ++i) {
        end[i] = end_beyond(frame.scale() * hits.t[i]);
        has_end[i] = static_cast<int>(is_end_known(frame.scale() * hits.t_error[i])) &
                     static_cast<int>(seen >> i & 1U);
    }
    for (std::size_t i = 0; i < packet_size; ++i) {
        proxy_rays.t_far[i] = has_end[i] != 0 ? end[i] : infinity;
    }
    return bits_of(is_far);
}

GNOMON_WIDEST_VECTORS
void narrow(const Lanes3& origins, FloatRays& rays)
{
    for (std::size_t i = 0; i < packet_size; ++i) {
        rays.origin_x[i] = static_cast<float>(origins.x[i]);
        rays.origin_y[i] = static_cast<float>(origins.y[i]);
        rays.origin_z[i] = static_cast<float>(origins.z[i]);
    }
}

} // namespace

void proxy_rays_for(const LaneRays& rays, const LaneHits& hits, LaneBits seen,
                    const UnitFrame& frame, FloatRays& proxy_rays, LanePositions& origins)
{
    LaneBits far = proxy_near_scene(rays, hits, seen, frame, proxy_rays, origins);
    for (; far != 0; far &= far - 1) {
        const std::size_t lane = first_lane(far);
        const CameraProxyRays proxy{rays.ray(lane), frame};
        const bool is_seen = (seen >> lane & 1U) != 0;
        const float t_far = is_seen ? proxy.t_beyond(hits.t[lane], hits.t_error[lane]) : infinity;
        origins.set(lane, proxy.origin());
        proxy_rays.set(lane, proxy.ray(t_far));
    }
}

void CameraProxyRays::begin_near_scene(const Ray& ray)
{
    // Starts 2.5 before the point nearest to the frame's origin, as the box reaches to √3.
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

ShadowProxyRays::ShadowProxyRays(const Light& light, const UnitFrame& frame)
    : has_position_{light.has_position()}
{
    if (has_position_) {
        positional_ = frame.from_world(light.position);
    } else {
        to_directional_ = Vec3f{normalised(-light.direction)};
    }
}

void ShadowProxyRays::from(const LanePositions& points, LaneBits lanes, FloatRays& rays) const
{
    if (has_position_) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const std::size_t lane = first_lane(lanes);
            rays.set(lane, ray_to_positional(points.at(lane)));
        }
        return;
    }
    narrow(points.position, rays);
    rays.direction_x.fill(to_directional_.x);
    rays.direction_y.fill(to_directional_.y);
    rays.direction_z.fill(to_directional_.z);
    rays.t_far.fill(infinity);
}

FloatRay ShadowProxyRays::ray_to_positional(const Vec3d& point) const
{
    const Vec3d to_light = positional_ - point;
    const double length = largest(to_light);
    if (length < 0x1p-60) { // the segment is a point, so any direction will do
        return {Vec3f{point}, Vec3f{1, 0, 0}, 0, static_cast<float>(box_padding), casters};
    }
    const Vec3d direction = normalised(to_light);
    // The signs reject triangles beyond the light.
    const double t_far = 1.001 * length / largest(direction) + box_padding;
    return {Vec3f{point}, Vec3f{direction}, 0, static_cast<float>(t_far), casters};
}

} // namespace gnomon::reference_rt
