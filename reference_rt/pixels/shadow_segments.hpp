#pragma once

#include "reference_rt/exact/contact.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "reference_rt/traversal/float_line_filter.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "reference_rt/traversal/proxy_rays.hpp"
#include "reference_rt/traversal/unit_frame.hpp"
#include "scene/light/light.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::reference_rt {

/// The goal of a search along segments to the light.
enum class SegmentGoal : std::uint8_t {
    any_blocker,     ///< the first triangle that properly crosses settles a lane
    nearest_blocker, ///< the witness is the blocker nearest to the light
};

/// The part of the scene that a shadow map can hold; everything without depth and culling.
struct SegmentScope {
    const LightDepth* depth =
        nullptr; ///< if set, crossings count only at depths in [0, 1]; not owned
    scene::Cull cull = scene::Cull::none;
};

/// The light data shared by all segments of an image.
struct SegmentLight {
    SegmentLight(const ReferenceScene::Implementation& reference, const scene::Light& light_in)
        : light{light_in},
          ray_bundle{reference.frame, light_in},
          proxy{light_in, reference.frame}
    {
    }

    const scene::Light& light;
    RayBundle ray_bundle;
    ShadowProxyRays proxy;
};

/// The start points of a packet's segments.
struct SegmentStarts {
    LaneBits lanes = 0; ///< lanes with a segment; their δ is not 0
    /// Lanes whose points Embree's rays cannot start from; they are tested against every caster.
    LaneBits beyond_embree = 0;
    /// P from `find_unit_points`; for a distant P, a later point of the segment, which meets
    /// nothing before it.
    LanePositions points{};
    Lanes<std::uint32_t> triangles{};                     ///< T
    std::function<const Receiver&(std::size_t)> receiver; ///< by lane; rarely called
};

/// The contacts of a packet's open segments P→light with triangles in scope, each decided exactly.
[[nodiscard]] PacketOf<SegmentContacts>
trace_segments(const ReferenceScene::Implementation& reference, const SegmentLight& light,
               SegmentStarts& starts, SegmentGoal goal, SignCounts& counts,
               const SegmentScope& scope = {});
[[nodiscard]] PacketOf<SegmentContacts>
trace_segments(const ReferenceScene::Implementation& reference, const SegmentLight& light,
               const PacketMask& valid, const PacketOf<Receiver>& receivers, SegmentGoal goal,
               SignCounts& counts, const SegmentScope& scope = {});

/// Computes where the segments of given points start in the unit frame, for points at any distance.
///
/// Embree's rays must start near the scene (`farthest_origin`). A segment from farther away starts
/// where it comes near the scene, as it meets nothing before.
class PointStarts {
public:
    /// Both must outlive this object.
    PointStarts(const UnitFrame& frame, const scene::Light& light);

    /// Adds the lane, unless its segment never comes near the scene.
    /// @param receiver  a point at barycentric coordinates.
    void add(std::size_t lane, const Receiver& receiver, SegmentStarts& starts) const;

private:
    void add_far(std::size_t lane, const Receiver& receiver, const IntervalPoint& point,
                 SegmentStarts& starts) const;
    [[nodiscard]] IntervalPoint exact_start(const Receiver& receiver, double share) const;

    const UnitFrame& frame_;
    const scene::Light& light_;
    scene::Vec3d
        unit_light_{}; ///< position in the unit frame, or the direction to a directional light
};

} // namespace gnomon::reference_rt
