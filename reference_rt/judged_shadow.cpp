#include "reference_rt/shadow_rays.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

namespace gnomon::reference_rt {

using scene::Light;
using scene::LightType;
using scene::Vec3d;
using scene::Vec3f;

namespace {

struct EdgeContact {
    std::size_t lane = 0;
    std::uint32_t triangle = scene::no_triangle;
    int edge = 0;
};

/// The segments of one packet while Embree traverses them.
struct Segments {
    const ReferenceScene::Implementation& reference;
    const Light& light;
    const PacketOf<Receiver>& receivers;
    PacketOf<SegmentContacts> contacts;
    std::vector<EdgeContact> edges;
    bool is_out_of_memory = false;

    /// True when the triangle settles the lane's segment; contacts that do not are kept.
    bool judge(std::size_t lane, std::uint32_t triangle)
    {
        const Receiver& receiver = receivers[lane];
        if (triangle == receiver.triangle) {
            return false; // the segment meets its plane at P only
        }
        const Corners corners = corners_of(reference.triangles, triangle);
        const ShadowSigns signs = shadow_signs(receiver, corners, light);
        switch (classify_contact(signs)) {
        case Contact::none:
            break;
        case Contact::cross:
            contacts[lane].witness = triangle;
            return true;
        case Contact::edge:
            edges.push_back({lane, triangle, touched_edge(signs)});
            break;
        case Contact::vertex:
            contacts[lane].touches_vertex = true;
            break;
        case Contact::plane:
            contacts[lane].runs_in_triangle |= runs_through(receiver, corners, light);
            break;
        }
        return false;
    }
};

void judge_proposals(const RTCFilterFunctionNArguments* arguments) noexcept
{
    auto& segments = embree::payload_of<Segments>(*arguments);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) {
            continue;
        }
        const std::uint32_t triangle =
            segments.reference.triangle(RTCHitN_geomID(arguments->hit, arguments->N, i),
                                        RTCHitN_primID(arguments->hit, arguments->N, i));
        try {
            if (!segments.judge(RTCRayN_id(arguments->ray, arguments->N, i), triangle)) {
                arguments->valid[i] = 0;
            }
        } catch (const std::bad_alloc&) {
            segments.is_out_of_memory = true; // thrown again outside Embree
        }
    }
}

/// The ray whose hits include every triangle that the segment P→light can meet near its ends: float
/// rounding moves P, and the distances that Embree computes, by a few ulp of the scene's
/// coordinates, so the ray begins 64 of them behind P (room for contacts down to 4° from grazing)
/// and ends as far beyond a spot.
FloatRay proposing_ray(const Segments& segments, const Receiver& receiver)
{
    const Vec3d point = receiver.point();
    const Vec3d size = glm::abs(point);
    const double magnitude =
        std::max({segments.reference.largest_coordinate_m, size.x, size.y, size.z});
    const double margin_m = 64 * 0x1p-24 * magnitude;
    if (segments.light.type == LightType::directional) {
        // A power of two keeps the direction's bits and brings its length near 1.
        const Vec3d d = -segments.light.direction;
        const Vec3d direction = d * std::ldexp(1.0, -std::ilogb(glm::length(d)));
        return {Vec3f{point - margin_m / glm::length(direction) * direction}, Vec3f{direction}, 0,
                std::numeric_limits<float>::infinity(), casters};
    }
    const Vec3d to_light = segments.light.position - point;
    const double length_m = glm::length(to_light);
    const Vec3d direction = to_light / length_m;
    return {Vec3f{point - margin_m * direction}, Vec3f{direction}, 0,
            static_cast<float>(length_m + 2 * margin_m), casters};
}

/// True when `other` has the edge (u, v), in either direction; `apex` becomes its third corner.
bool shares_edge(const Corners& other, const Vec3d& u, const Vec3d& v, Vec3d& apex)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d& from = other[i];
        const Vec3d& to = other[(i + 1) % 3];
        if ((from == u && to == v) || (from == v && to == u)) {
            apex = other[(i + 2) % 3];
            return true;
        }
    }
    return false;
}

/// True when the two triangles' surface passes through the segment at the edge of `contact`.
bool forms_seam(const Segments& segments, const EdgeContact& contact, const EdgeContact& other)
{
    const Corners corners = corners_of(segments.reference.triangles, contact.triangle);
    const auto edge = static_cast<std::size_t>(contact.edge);
    const Vec3d& u = corners[edge];
    const Vec3d& v = corners[(edge + 1) % 3];
    Vec3d other_apex;
    return shares_edge(corners_of(segments.reference.triangles, other.triangle), u, v,
                       other_apex) &&
           is_seam(apex_side(segments.light, u, v, corners[(edge + 2) % 3]),
                   apex_side(segments.light, u, v, other_apex));
}

/// Pairs up the edge contacts: a seam blocks, with its lower triangle as the witness.
void resolve_edges(Segments& segments)
{
    for (const EdgeContact& contact : segments.edges) {
        SegmentContacts& found = segments.contacts[contact.lane];
        found.touches_edge = true;
        for (const EdgeContact& other : segments.edges) {
            if (other.lane == contact.lane && forms_seam(segments, contact, other)) {
                found.witness = std::min({found.witness, contact.triangle, other.triangle});
            }
        }
    }
}

} // namespace

PacketOf<SegmentContacts> trace_judged(const ReferenceScene::Implementation& reference,
                                       const Light& light, const PacketMask& valid,
                                       const PacketOf<Receiver>& receivers)
{
    Segments segments{reference, light, receivers, {}, {}};
    RTCRay16 packet;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (valid[i]) {
            set_lane(packet, i, proposing_ray(segments, receivers[i]));
        }
    }
    embree::Query query{embree::Coherence::coherent, &judge_proposals, &segments};
    embree::occluded16(valid.lane.data(), reference.scene.get(), query, packet);
    if (segments.is_out_of_memory) {
        throw std::bad_alloc{};
    }
    resolve_edges(segments);
    return segments.contacts;
}

} // namespace gnomon::reference_rt
