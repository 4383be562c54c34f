#pragma once

#include "reference_rt/exact/contact.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "reference_rt/traversal/float_line_filter.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "reference_rt/traversal/proxy_rays.hpp"
#include "scene/light/light.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::reference_rt {

/// What a search along the segments to the light is for.
enum class SegmentGoal : std::uint8_t {
    any_blocker,     ///< a lane is settled by the first triangle that properly crosses it
    nearest_blocker, ///< the witness is the blocker nearest to the light
};

/// What of the scene a shadow map could hold; without depth and culling, all of it.
struct SegmentScope {
    const LightDepth* depth = nullptr; ///< crossings count at a depth in [0, 1]; not owned
    scene::Cull cull = scene::Cull::none;
};

/// Everything about the light that all segments of an image share.
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

/// Where the segments of a packet begin.
struct SegmentStarts {
    LaneBits lanes = 0; ///< those with a segment; their δ is not 0
    /// Those of them whose points Embree's rays cannot start from: they are shown every caster.
    LaneBits beyond_embree = 0;
    /// P, as `find_unit_points` leaves it; or, of a P far away, a later point of the segment before
    /// which it meets nothing.
    LanePositions points{};
    Lanes<std::uint32_t> triangles{};                     ///< T
    std::function<const Receiver&(std::size_t)> receiver; ///< of a lane; few are asked for
};

/// What meets the open segments P→light of a packet: every triangle that the segment touches is a
/// candidate, and each is decided exactly. What is out of scope is no contact.
[[nodiscard]] PacketOf<SegmentContacts>
trace_segments(const ReferenceScene::Implementation& reference, const SegmentLight& light,
               SegmentStarts& starts, SegmentGoal goal, SignCounts& counts,
               const SegmentScope& scope = {});
[[nodiscard]] PacketOf<SegmentContacts>
trace_segments(const ReferenceScene::Implementation& reference, const SegmentLight& light,
               const PacketMask& valid, const PacketOf<Receiver>& receivers, SegmentGoal goal,
               SignCounts& counts, const SegmentScope& scope = {});

} // namespace gnomon::reference_rt
