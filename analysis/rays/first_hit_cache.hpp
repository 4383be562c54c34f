#pragma once

#include "renderers/light_queries.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Caches the first surface that a light sees through the texels of its maps. Serves maps that
/// differ only in the near plane, and single maps that stay unchanged while others of the light
/// change.
class FirstHitCache {
public:
    /// @param most_texels  Capacity, over all maps; 8 bytes each.
    explicit FirstHitCache(std::size_t most_texels) : room_{most_texels} {}

    /// The maps whose texels to look through, and their light.
    struct Maps {
        const renderers::LightQueries& light;
        std::span<const scene::LightFrustum> frusta; ///< of the light
        int resolution_texels = 0;
        scene::Cull cull = scene::Cull::none; ///< of the light
    };

    /// The first hits of the texels, with positions, in their order. Usually needs no tracing if
    /// the same texels were requested with a nearer near plane, or if the texel's map is one of
    /// several and unchanged.
    [[nodiscard]] std::vector<renderers::TexelHit> first_hits(const Maps& maps,
                                                              std::span<const scene::Texel> texels);

private:
    /// 14 bits for each coordinate and 4 for the map: a map has at most 16384 texels along a side,
    /// and a light at most 16 maps.
    using Packed = std::uint32_t;

    struct Seen {
        int resolution_texels = 0;
        scene::Cull cull = scene::Cull::none;
        std::vector<scene::LightFrustum> frusta;
        std::vector<Packed> texels;
        std::vector<std::uint32_t> triangles; ///< by texel
    };

    static Packed packed(const scene::Texel& texel);
    [[nodiscard]] static bool is_of(const Seen& seen, std::span<const scene::Texel> texels);
    [[nodiscard]] Seen* find(const Maps& maps);
    /// The triangle seen through each texel; `no_triangle` if unknown.
    [[nodiscard]] static std::vector<std::uint32_t>
    known_triangles(const Seen& seen, std::span<const scene::Texel> texels);
    void remember(const Maps& maps, std::span<const scene::Texel> texels,
                  std::span<const renderers::TexelHit> hits);

    std::size_t room_; ///< remaining capacity [texels]
    std::vector<Seen> seen_;
};

} // namespace gnomon::analysis
