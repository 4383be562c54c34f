#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "scene/light/light.hpp"

#include <cstdint>

namespace gnomon::reference_rt {

/// How a float shadow ray is kept from its own surface.
enum class PlainOffset : std::uint8_t {
    none,         ///< not at all
    ray_start,    ///< the ray starts 1e-4 of the scene's diagonal off P
    own_triangle, ///< hits of the receiver's own triangle are ignored
    integer,      ///< the origin is moved by ulps along the normal (Wächter and Binder 2019)
};

/// The valid lanes in which a plain float ray from P to the light meets a triangle.
[[nodiscard]] PacketMask trace_plain(const ReferenceScene::Implementation& reference,
                                     const scene::Light& light, PlainOffset offset,
                                     const PacketMask& valid, const PacketOf<Receiver>& receivers);

} // namespace gnomon::reference_rt
