#pragma once

#include "reference_rt/light/maps_of_light.hpp"
#include "renderers/light_queries.hpp"
#include "scene/light/frustum.hpp"

#include <cstdint>
#include <span>

namespace gnomon::reference_rt {

/// Whether what one frustum of a light sees first along the rays of texels is what another sees
/// first, if it sees it: the rays are the same doubles, and the other begins no nearer to the light
/// along any of them. A directional light's rays begin on the near plane, and are the same only if
/// that is.
///
/// Near planes are linear, and the rays of a spot's texels are positive sums of those through the
/// map's corners: what holds along these holds along all.
[[nodiscard]] bool keeps_first_hits(const scene::Light& light, const scene::LightFrustum& from,
                                    const scene::LightFrustum& to);

/// Places what is known to be seen first through texels, without tracing.
class KnownHitPlacer {
public:
    /// All arguments must outlive it.
    KnownHitPlacer(const scene::TriangleScene& triangles, const MapsOfLight& maps, std::size_t map)
        : triangles_{triangles},
          rays_{maps.rays[map]},
          depth_{maps.depths[map]},
          distance_{maps.distance(map)}
    {
    }

    /// Writes the hit of each texel on its triangle, placed as `TexelFirstHits` does; leaves it as
    /// it is without a triangle, and where that is not in the light's range.
    /// @param triangles  by texel; of the scene, or `no_triangle`.
    void place(std::span<const scene::Texel> texels, std::span<const std::uint32_t> triangles,
               std::span<renderers::TexelHit> hits) const;

private:
    const scene::TriangleScene& triangles_;
    const TexelRays& rays_;
    const LightDepth& depth_;
    const LightDistance* distance_;
};

} // namespace gnomon::reference_rt
