#pragma once

#include "reference_rt/light/maps_of_light.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "reference_rt/traversal/float_line_filter.hpp"
#include "renderers/light_queries.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>
#include <span>

namespace gnomon::reference_rt {

/// Finds the first hits of the light's rays through texel centres.
class TexelFirstHits {
public:
    /// All arguments must outlive this object.
    TexelFirstHits(const ReferenceScene::Implementation& reference, const MapsOfLight& maps,
                   std::size_t map, scene::Cull cull, renderers::HitDetail detail)
        : reference_{reference},
          rays_{maps.rays[map]},
          depth_{maps.depths[map]},
          distance_{maps.distance(map)},
          cull_{cull},
          detail_{detail},
          ray_bundle_{reference.frame, rays_.light()}
    {
    }

    /// The first hit of each texel. Fastest if sixteen in a row are neighbours.
    void find(std::span<const scene::Texel> texels, std::span<renderers::TexelHit> hits) const;
    /// The first hits exactly farther along the ray than the given ones.
    void find_second(std::span<const scene::Texel> texels,
                     std::span<renderers::TexelHit> hits) const;

private:
    const ReferenceScene::Implementation& reference_;
    const TexelRays& rays_;
    const LightDepth& depth_;
    const LightDistance* distance_;
    scene::Cull cull_;
    renderers::HitDetail detail_;
    RayBundle ray_bundle_;
};

/// Whether first hits of frustum `from` are also those of `to`, as far as `to` sees them: their
/// rays are the same doubles, and `to` starts no nearer to the light along any of them. A
/// directional light's rays start on the near plane, so they differ with it.
///
/// It is enough to test the map's corners: near planes are linear, and a spot's texel rays are
/// positive combinations of the corner rays.
[[nodiscard]] bool keeps_first_hits(const scene::Light& light, const scene::LightFrustum& from,
                                    const scene::LightFrustum& to);

/// Computes hits on known first triangles without tracing.
class KnownHitPlacer {
public:
    /// All arguments must outlive this object.
    KnownHitPlacer(const scene::TriangleScene& triangles, const MapsOfLight& maps, std::size_t map)
        : triangles_{triangles},
          rays_{maps.rays[map]},
          depth_{maps.depths[map]},
          distance_{maps.distance(map)}
    {
    }

    /// Writes each texel's hit on its known triangle, with `HitDetail::placed`. Leaves hits
    /// unchanged without a triangle, or if it is out of the light's range.
    /// @param triangles  for each texel, an index in the scene or `no_triangle`.
    void place(std::span<const scene::Texel> texels, std::span<const std::uint32_t> triangles,
               std::span<renderers::TexelHit> hits) const;

private:
    const scene::TriangleScene& triangles_;
    const TexelRays& rays_;
    const LightDepth& depth_;
    const LightDistance* distance_;
};

} // namespace gnomon::reference_rt
