#include "reference_rt/pixels/plain_shadow.hpp"

#include <glm/geometric.hpp>

#include <bit>
#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

using scene::Vec3d;
using scene::Vec3f;

namespace {

/// A position moved off its surface along the unit normal: 256 ulps per unit of the normal, 2^-16
/// near the origin. Source: C. Wächter and N. Binder, "A Fast and Robust Method for Avoiding
/// Self-Intersection", Ray Tracing Gems (2019), chapter 6.
Vec3f offset_by_ulps(const Vec3f& position, const Vec3f& normal)
{
    constexpr float near_origin = 1.0F / 32;
    Vec3f moved;
    for (int i = 0; i < 3; ++i) {
        const auto steps = static_cast<std::int32_t>(256.0F * normal[i]);
        const auto bits = std::bit_cast<std::int32_t>(position[i]);
        moved[i] = std::abs(position[i]) < near_origin
                       ? position[i] + normal[i] / 65536.0F
                       : std::bit_cast<float>(bits + (position[i] < 0 ? -steps : steps));
    }
    return moved;
}

FloatRay plain_ray(const Receiver& receiver, const scene::Light& light, PlainOffset offset,
                   float t_near)
{
    const Vec3d point = receiver.point();
    const Vec3d to_light = light.way_from(point);
    const double length = glm::length(to_light);
    Vec3f origin{point};
    if (offset == PlainOffset::integer) {
        const Vec3d n = glm::normalize(glm::cross(receiver.corners()[1] - receiver.corners()[0],
                                                  receiver.corners()[2] - receiver.corners()[0]));
        origin = offset_by_ulps(origin, Vec3f{glm::dot(n, to_light) < 0 ? -n : n});
    }
    return {origin, Vec3f{to_light / length}, offset == PlainOffset::ray_start ? t_near : 0.0F,
            light.has_position() ? static_cast<float>(length)
                                 : std::numeric_limits<float>::infinity(),
            casters};
}

} // namespace

PacketMask trace_plain(const ReferenceScene::Implementation& reference, const scene::Light& light,
                       PlainOffset offset, const PacketMask& valid,
                       const PacketOf<Receiver>& receivers)
{
    const auto t_near = static_cast<float>(1e-4 * reference.bounds.diagonal_m());
    RTCRay16 packet;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (valid[i]) {
            set_lane(packet, i, plain_ray(receivers[i], light, offset, t_near));
        }
    }
    return reference.find_occluded(valid, packet,
                                   offset == PlainOffset::own_triangle ? &receivers : nullptr);
}

} // namespace gnomon::reference_rt
