#pragma once

#include "reference_rt/truth.hpp"
#include "renderers/light_queries.hpp"
#include "scene/image.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <memory>

namespace gnomon::reference_rt {

/// Exact answers about the light's rays. Source: docs/causes.md, docs/truth.md.
///
/// @param reference  serves exact truth; it, `view` and `receivers` must outlive the result.
/// @param receivers  GL's triangle per pixel, of size `view.image`.
/// @param resolution_texels  of the shadow map; [1, 16384].
/// @param threads    0 for all cores.
/// @throws std::invalid_argument  if an argument is out of range. The result's methods throw it for
///                                a texel outside the map, a triangle outside the scene, or a pixel
///                                without a receiver.
[[nodiscard]] std::unique_ptr<renderers::LightQueries>
make_light_queries(const ReferenceScene& reference, const scene::View& view,
                   const scene::Image<std::uint32_t>& receivers, int resolution_texels,
                   scene::Cull cull, int threads = 0);

} // namespace gnomon::reference_rt
