#include "raster_gl/shadow_volumes.hpp"

#include "scene/geometry/surfaces.hpp"
#include "scene/light/facing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <tuple>
#include <utility>

namespace gnomon::raster_gl {
namespace {

using methods::Casters;
using methods::Extrusion;

/// An edge of a caster, from the lower vertex index to the higher. `sign` is the caster's facing,
/// negated if its winding runs from higher to lower.
struct CasterEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    int sign = 0;

    [[nodiscard]] bool joins_as(const CasterEdge& other) const
    {
        return from == other.from && to == other.to;
    }
};

class VolumeBuilder {
public:
    VolumeBuilder(const scene::TriangleScene& triangles, const scene::Light& light,
                  const methods::ShadowVolumes& volumes)
        : triangles_{triangles},
          volumes_{volumes},
          facings_{scene::facings(triangles, light)}
    {
    }

    /// Calls `visit(triangle, facing)` for each caster that has a volume.
    template <typename Visit>
    void visit_casters(const Visit& visit) const
    {
        for (const scene::TriangleRange& range : casting_ranges(triangles_)) {
            for (std::uint32_t t = range.first; t < range.first + range.count; ++t) {
                const int facing = facings_[t];
                if (facing > 0 || (facing < 0 && volumes_.casters == Casters::all)) {
                    visit(t, facing);
                }
            }
        }
    }

    [[nodiscard]] VolumeGeometry build() const
    {
        VolumeGeometry made;
        visit_casters([&](std::uint32_t t, int facing) {
            (facing > 0 ? made.along : made.against).caps.push_back(triangles_.triangles[t]);
        });
        std::vector<CasterEdge> edges = caster_edges();
        if (volumes_.extrusion == Extrusion::silhouette) {
            edges = silhouettes(std::move(edges));
        }
        for (const CasterEdge& edge : edges) {
            VolumeFaces& faces = edge.sign > 0 ? made.along : made.against;
            for (int i = 0; i < std::abs(edge.sign); ++i) {
                faces.sides.push_back({edge.from, edge.to});
            }
        }
        return made;
    }

private:
    [[nodiscard]] std::vector<CasterEdge> caster_edges() const
    {
        const std::vector<std::uint32_t> first = scene::first_of_equals(triangles_.vertices);
        std::vector<CasterEdge> edges;
        visit_casters([&](std::uint32_t t, int facing) {
            const auto& corners = triangles_.triangles[t];
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = first[corners[i]];
                const std::uint32_t to = first[corners[(i + 1) % 3]];
                edges.push_back(from < to ? CasterEdge{from, to, facing}
                                          : CasterEdge{to, from, -facing});
            }
        });
        return edges;
    }

    /// Each edge once with the sum of its signs, without edges whose signs cancel.
    static std::vector<CasterEdge> silhouettes(std::vector<CasterEdge> edges)
    {
        std::ranges::sort(edges, {}, [](const CasterEdge& edge) {
            return std::pair{edge.from, edge.to};
        });
        std::vector<CasterEdge> joined;
        for (const CasterEdge& edge : edges) {
            if (!joined.empty() && joined.back().joins_as(edge)) {
                joined.back().sign += edge.sign;
            } else {
                joined.push_back(edge);
            }
        }
        std::erase_if(joined, [](const CasterEdge& edge) { return edge.sign == 0; });
        return joined;
    }

    const scene::TriangleScene& triangles_;
    methods::ShadowVolumes volumes_;
    std::vector<int> facings_;
};

} // namespace

VolumeGeometry volume_geometry(const scene::TriangleScene& triangles, const scene::Light& light,
                               const methods::ShadowVolumes& volumes)
{
    return VolumeBuilder{triangles, light, volumes}.build();
}

} // namespace gnomon::raster_gl
