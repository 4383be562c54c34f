#pragma once

#include "reference_rt/contact.hpp"
#include "reference_rt/double_predicates.hpp"
#include "reference_rt/embree_scene.hpp"
#include "reference_rt/packet.hpp"
#include "scene/light.hpp"

namespace gnomon::reference_rt {

/// What meets the segments P→light of a packet. Embree proposes triangles along a slightly longer
/// ray; each is judged by its five signs, so that no contact is lost to a ray epsilon and none is
/// invented by rounding.
[[nodiscard]] PacketOf<SegmentContacts>
trace_judged(const ReferenceScene::Implementation& reference, const scene::Light& light,
             const PacketMask& valid, const PacketOf<Receiver>& receivers);

/// True where a plain float ray, started 1e-4 of the scene's diagonal off P, meets a triangle.
[[nodiscard]] PacketOf<bool> trace_plain(const ReferenceScene::Implementation& reference,
                                         const scene::Light& light, const PacketMask& valid,
                                         const PacketOf<Receiver>& receivers);

} // namespace gnomon::reference_rt
