#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/reference_scene.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "renderers/values.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/truth.hpp"
#include "scene/view/view.hpp"

#include <cstdint>

/// The two methods behind `compute_truth`, which checks preconditions.
namespace gnomon::reference_rt {

[[nodiscard]] scene::Truth classify_exactly(const ReferenceScene::Implementation& reference,
                                            const scene::View& view,
                                            const scene::Image<std::uint32_t>& receivers,
                                            const renderers::RasterFacts& raster, int threads);

/// Trusts GL's triangles. Decides `attached` and `out_of_light` by exact signs, the rest by one
/// float ray per pixel, which starts 1e-4 of the scene's diagonal off P.
[[nodiscard]] scene::Truth classify_by_plain_rays(const ReferenceScene::Implementation& reference,
                                                  const scene::View& view,
                                                  const scene::Image<std::uint32_t>& receivers,
                                                  int threads);

[[nodiscard]] inline scene::Truth empty_layers(scene::ImageSize image)
{
    return {scene::Image<scene::PixelClass>{image},
            scene::Image<scene::ClassReason>{image},
            scene::Image<std::uint32_t>{image, scene::no_triangle},
            {}};
}

/// How a float shadow ray avoids hitting its own surface.
enum class PlainOffset : std::uint8_t {
    none,         ///< no offset
    ray_start,    ///< the ray starts 1e-4 of the scene's diagonal off P
    own_triangle, ///< ignores hits of the receiver's own triangle
    integer,      ///< moves the origin by ulps along the normal (Wächter and Binder 2019)
};

/// The valid lanes in which a plain float ray from P to the light meets a triangle.
[[nodiscard]] PacketMask trace_plain(const ReferenceScene::Implementation& reference,
                                     const scene::Light& light, PlainOffset offset,
                                     const PacketMask& valid, const PacketOf<Receiver>& receivers);

} // namespace gnomon::reference_rt
