#pragma once

#include "reference_rt/light/maps_of_light.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "reference_rt/traversal/float_line_filter.hpp"
#include "renderers/light_queries.hpp"
#include "scene/settings/job.hpp"

#include <span>

namespace gnomon::reference_rt {

/// Finds what the light sees through the centres of texels.
class TexelFirstHits {
public:
    /// All arguments must outlive it.
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

    /// The first hits of texels, packet by packet: best where sixteen in a row are neighbours.
    void find(std::span<const scene::Texel> texels, std::span<renderers::TexelHit> hits) const;
    /// The first hits behind those: exactly farther along the ray.
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

} // namespace gnomon::reference_rt
