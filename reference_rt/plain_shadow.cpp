#include "reference_rt/shadow_rays.hpp"

#include <glm/geometric.hpp>

#include <limits>

namespace gnomon::reference_rt {

using scene::Vec3d;
using scene::Vec3f;

PacketOf<bool> trace_plain(const ReferenceScene::Implementation& reference,
                           const scene::Light& light, const PacketMask& valid,
                           const PacketOf<Receiver>& receivers)
{
    const bool is_directional = light.type == scene::LightType::directional;
    const auto t_near = static_cast<float>(1e-4 * reference.bounds.diagonal_m());
    RTCRay16 packet;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!valid[i]) {
            continue;
        }
        const Vec3d point = receivers[i].point();
        const Vec3d to_light = is_directional ? -light.direction : light.position - point;
        const double length = glm::length(to_light);
        set_lane(
            packet, i,
            {Vec3f{point}, Vec3f{to_light / length}, t_near,
             is_directional ? std::numeric_limits<float>::infinity() : static_cast<float>(length),
             casters});
    }
    embree::Query query{embree::Coherence::coherent};
    embree::occluded16(valid.lane.data(), reference.scene.get(), query, packet);
    PacketOf<bool> is_blocked{};
    for (std::size_t i = 0; i < packet_size; ++i) {
        is_blocked[i] = valid[i] && packet.tfar[i] < 0; // Embree's mark of an occluded ray: −∞
    }
    return is_blocked;
}

} // namespace gnomon::reference_rt
