#include "analysis/evaluate/offset_check.hpp"

#include "methods/job_method.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::Vec3d;

/// Positions, matrices and normals in float32 move a lookup by less; other normals by more.
constexpr double most_off_texels = 0.125;

/// Whose normals an offset follows.
enum class NormalsOf : std::uint8_t { triangles, vertices };

std::string_view words(NormalsOf normals)
{
    return normals == NormalsOf::triangles ? "the triangles" : "the vertices";
}

/// Where an offset of the case leads to from P.
class OffsetLookups {
public:
    OffsetLookups(const Comparison& comparison, const scene::CaseLayers& layers)
        : comparison_{comparison},
          layers_{layers}
    {
    }

    /// How far the lookups of all scored pixels but one in a hundred are from there [texels]; 0
    /// where nothing is offset.
    [[nodiscard]] double largest_distance_texels(NormalsOf normals) const
    {
        std::vector<double> distances;
        for (std::size_t i = 0; i < layers_.texels.pixel_count(); ++i) {
            const auto map = static_cast<std::size_t>(scene::map_of(comparison_.lookup.maps, i));
            const bool is_known = scene::is_scored(comparison_.truth.pixel_class[i]) &&
                                  !std::isnan(comparison_.evaluation->normal[i].x) &&
                                  !is_moved_to_another_map(i);
            if (is_known) {
                const scene::Vec2d off = scene::Vec2d{layers_.texels[i]} - texel(i, map, normals);
                const double distance = std::max(std::abs(off.x), std::abs(off.y));
                distances.push_back(std::isnan(distance) ? HUGE_VAL : distance);
            }
        }
        if (distances.empty()) {
            return 0;
        }
        const auto nth =
            distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 99 / 100);
        std::nth_element(distances.begin(), nth, distances.end());
        return *nth;
    }

private:
    [[nodiscard]] bool is_moved_to_another_map(std::size_t pixel) const
    {
        return !layers_.maps.empty() && !layers_.unmoved.maps.empty() &&
               layers_.maps[pixel] != layers_.unmoved.maps[pixel];
    }

    [[nodiscard]] Vec3d normal(std::size_t pixel, const Vec3d& point, NormalsOf normals) const
    {
        const Vec3d seen{comparison_.evaluation->normal[pixel]};
        if (normals == NormalsOf::triangles) {
            return seen;
        }
        const Vec3d smooth = scene::vertex_normal_at(*comparison_.triangles,
                                                     comparison_.receivers.triangle[pixel], point);
        return glm::dot(smooth, seen) < 0 ? -smooth : smooth;
    }

    [[nodiscard]] scene::Vec2d texel(std::size_t pixel, std::size_t map, NormalsOf normals) const
    {
        const scene::LightFrustum& frustum = comparison_.view.maps[map];
        const Vec3d point{layers_.position[pixel]};
        const double length_m = methods::normal_offset_m(comparison_.job, comparison_.view, map,
                                                         frustum.light_distance_m(point))
                                    .value_or(0);
        const scene::Vec4d clip =
            scene::Mat4d{frustum.light_clip_from_world} *
            scene::Vec4d{point + length_m * normal(pixel, point, normals), 1.0};
        return (scene::Vec2d{clip} / clip.w * 0.5 + 0.5) *
               static_cast<double>(comparison_.job.shadow_map.resolution_texels);
    }

    const Comparison& comparison_;
    const scene::CaseLayers& layers_;
};

} // namespace

std::string check_offset(const Comparison& comparison, const scene::CaseLayers& layers)
{
    if (methods::normal_offset_m(comparison.job, comparison.view, 0, 1.0).value_or(0) == 0) {
        return {};
    }
    const bool follows_vertices =
        methods::vertex_normals(comparison.job) == scene::VertexNormals::kept;
    const NormalsOf said = follows_vertices ? NormalsOf::vertices : NormalsOf::triangles;
    const NormalsOf other = follows_vertices ? NormalsOf::triangles : NormalsOf::vertices;
    const OffsetLookups lookups{comparison, layers};
    const double off_texels = lookups.largest_distance_texels(said);
    if (off_texels <= most_off_texels) {
        return {};
    }
    std::string sentence =
        fmt::format("lookups are up to {:.3g} texels from where the case's offset along the "
                    "normals of {} leads",
                    off_texels, words(said));
    const bool knows_other =
        other == NormalsOf::triangles || !comparison.triangles->attributes.empty();
    if (knows_other && lookups.largest_distance_texels(other) <= most_off_texels) {
        return sentence + fmt::format("; along those of {} they fit: say bias.normal_from = \"{}\"",
                                      words(other),
                                      other == NormalsOf::vertices ? "vertices" : "geometry");
    }
    return sentence + "; correct the keys of [bias], or the normals of the mesh";
}

} // namespace gnomon::analysis
