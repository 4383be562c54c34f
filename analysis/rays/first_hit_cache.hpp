#pragma once

#include "renderers/light_queries.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// What one light saw first through the texels of its maps, for maps that differ in the near plane
/// alone, and of several maps for those that stay the same beside others.
class FirstHitCache {
public:
    /// @param most_texels  that it remembers, of all maps together: 8 bytes each.
    explicit FirstHitCache(std::size_t most_texels) : room_{most_texels} {}

    /// The maps whose texels are asked for, and the light that sees through them.
    struct Maps {
        const renderers::LightQueries& light;
        std::span<const scene::LightFrustum> frusta; ///< the light's
        int resolution_texels = 0;
        scene::Cull cull = scene::Cull::none; ///< the light's
    };

    /// The texels' first hits, placed, in their order; as a rule without tracing where the same
    /// texels were asked for with a nearer near plane, or a texel of a map that is one of several
    /// and was the same.
    [[nodiscard]] std::vector<renderers::TexelHit> first_hits(const Maps& maps,
                                                              std::span<const scene::Texel> texels);

private:
    /// Coordinates as 14 bits each, and the map as 4: a map has at most 16384 texels along a side,
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
    /// Of each texel the triangle seen there, `no_triangle` where that is not known.
    [[nodiscard]] static std::vector<std::uint32_t>
    known_triangles(const Seen& seen, std::span<const scene::Texel> texels);
    void remember(const Maps& maps, std::span<const scene::Texel> texels,
                  std::span<const renderers::TexelHit> hits);

    std::size_t room_; ///< texels for which there is room
    std::vector<Seen> seen_;
};

} // namespace gnomon::analysis
