#pragma once

#include "reference_rt/reference_scene.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "renderers/values.hpp"
#include "scene/pixels/truth.hpp"
#include "scene/view/view.hpp"

/// The two methods behind `compute_truth`; preconditions have been checked there.
namespace gnomon::reference_rt {

[[nodiscard]] scene::Truth classify_exactly(const ReferenceScene::Implementation& reference,
                                            const scene::View& view,
                                            const scene::Image<std::uint32_t>& receivers,
                                            const renderers::RasterFacts& raster, int threads);

/// Takes GL's triangles as seen; exact signs for `attached` and `out_of_light`, and one float ray
/// per pixel, started 1e-4 of the scene's diagonal off P, for the rest.
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

} // namespace gnomon::reference_rt
