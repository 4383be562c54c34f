#include "analysis/evaluate/case_causes.hpp"

#include "analysis/depth/depth_mapping.hpp"
#include "analysis/evaluate/case_checks.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "methods/job_method.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::Vec3d;
using scene::View;

bool is_judged_point(const scene::Vec3f& p)
{
    return !std::isnan(p.x);
}

/// The largest value but the highest hundredth.
double largest_but_few(std::vector<double>& values)
{
    return nth_smallest(values, values.size() * 99 / 100);
}

/// The value that the map stores for a point.
double depth_of(const scene::LightFrustum& frustum, const Vec3d& point)
{
    const scene::Vec4d clip =
        scene::Mat4d{frustum.light_clip_from_world} * scene::Vec4d{point, 1.0};
    const scene::Measure measure = traits_of(frustum.content).measure;
    if (measure == scene::Measure::clip_depth) {
        const double ndc = clip.z / clip.w;
        return frustum.clip_range == scene::ClipRange::minus_one_to_one ? 0.5 * ndc + 0.5 : ndc;
    }
    return DepthMapping{frustum.stored_range()}.depth(
        measure == scene::Measure::ray ? glm::length(point - frustum.origin) : clip.w);
}

/// Whether the file sets a key to this word.
bool says(const scene::CaseFile& file, std::string_view key, std::string_view word)
{
    return std::ranges::any_of(file.source.file, [&](const scene::Setting& setting) {
        const auto* said = std::get_if<std::string>(&setting.value);
        return setting.spec->name == key && said != nullptr && *said == word;
    });
}

bool has_several_maps(const scene::CaseFile& file)
{
    return says(file, "light.type", "point") ||
           says(file, "shadow_map.layout", scene::map_layout_name(scene::MapLayout::cascades));
}

bool mixes_maps(const scene::CaseFile& file)
{
    return std::ranges::any_of(file.source.file, [](const scene::Setting& setting) {
        const auto* share = std::get_if<double>(&setting.value);
        return setting.spec->name == "shadow_map.blend" && share != nullptr && *share > 0;
    });
}

std::vector<std::string> missing_layers(const scene::CaseFile& file,
                                        const methods::LookupTraits& traits,
                                        const scene::CaseLayers& layers)
{
    std::vector<std::string> missing;
    const auto need = [&](bool is_there, std::string_view what) {
        if (!is_there) {
            missing.emplace_back(what);
        }
    };
    need(!layers.z_light.empty(), "z.light");
    need(!layers.z_map.empty(), "z.map");
    need(!layers.texels.empty(), "texel.X and texel.Y");
    need(!layers.maps.empty() || !has_several_maps(file), "map_index");
    need(traits.has_one_tap() || !layers.map_depths.empty(), "map.file");
    need(!traits.scatters_taps() || !layers.kernel_axes.empty(), "kernel_axis.X and kernel_axis.Y");
    return missing;
}

/// Float32 positions, matrices and normals move a lookup by less; other normals by more.
constexpr double most_off_texels = 0.125;

/// Whose normals an offset follows.
enum class NormalsOf : std::uint8_t { triangles, vertices };

std::string_view words(NormalsOf normals)
{
    return normals == NormalsOf::triangles ? "the triangles" : "the vertices";
}

/// The lookups that the case's offset gives from P.
class OffsetLookups {
public:
    OffsetLookups(const Comparison& comparison, const scene::CaseLayers& layers)
        : comparison_{comparison},
          layers_{layers}
    {
    }

    /// How far the recorded lookups are from there [texels], but for the highest hundredth of
    /// scored pixels; 0 if there are none.
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
        return largest_but_few(distances);
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

std::vector<std::string> missing_for_causes(const scene::CaseFile& file, const scene::Job& job,
                                            const scene::CaseLayers& layers)
{
    // The traits for one map; blending of maps is checked below.
    const methods::LookupTraits traits = methods::method_of(job).traits(job);
    if (!traits.compares_depths() || traits.reads != methods::Reads::footprint) {
        return {"a method whose verdict follows from depths of a map"};
    }
    std::vector<std::string> missing;
    for (const std::string_view key :
         {"camera.target", "shadow_map.resolution", "shadow_map.depth_format", "shadow_map.fit",
          "shadow_map.near", "shadow_map.far", "lookup.filter", "lookup.outside"}) {
        const bool is_needed = key == "shadow_map.fit"  ? !has_several_maps(file)
                               : key == "lookup.filter" ? scene::has_filters(job)
                                                        : true;
        if (is_needed && !file.says(key)) {
            missing.emplace_back(key);
        }
    }
    if (std::ranges::none_of(scene::bias_units,
                             [&](const scene::BiasUnit& unit) { return file.says(unit.key); })) {
        missing.emplace_back(scene::bias_in_depth.key);
    }
    for (std::string& layer : missing_layers(file, traits, layers)) {
        missing.push_back(std::move(layer));
    }
    if (file.space.is_mirrored() || file.space.metres_per_unit != 1) {
        missing.emplace_back("right-handed axes and metres");
    }
    if (mixes_maps(file)) { // only GL's own lookups tell the causes of blended verdicts
        missing.emplace_back("shadow_map.blend = 0");
    }
    return missing;
}

std::string find_disagreement(const View& view, const scene::CaseLayers& layers,
                              const scene::TriangleScene& triangles,
                              const scene::Image<std::uint32_t>& receivers, double tolerance_m)
{
    // Float32 matrices and positions stay below it; another projection or range is far above.
    constexpr double depth_tolerance = 1e-4;
    const scene::MapIndices& maps =
        layers.unmoved.samples.empty() ? layers.maps : layers.unmoved.maps;
    if (view.maps.size() > 1 && (maps.empty() || std::ranges::max(maps) >= view.maps.size())) {
        return fmt::format(
            "unmoved.map_index, or without it map_index, from 0 to {}: of {}", view.maps.size() - 1,
            view.map_choice == scene::MapChoice::cube_face ? "the cube's faces +x −x +y −y +z −z"
                                                           : "the cascades, nearest first");
    }
    const ReceiverGeometry geometry{triangles, view, receivers};
    std::vector<double> lengths_m;
    std::vector<double> depths;
    for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
        if (!is_judged_point(layers.position[i]) || receivers[i] == scene::no_triangle) {
            continue;
        }
        const Vec3d point{layers.position[i]};
        const double length_m = glm::length(geometry.point(i) - point);
        lengths_m.push_back(std::isnan(length_m) ? HUGE_VAL : length_m);
        // A normal offset moves the lookup away from P.
        const double r{layers.unmoved.samples.empty() ? layers.z_light[i]
                                                      : layers.unmoved.samples[i].receiver_depth};
        if (r > 0 && r < 1) {
            const std::size_t map = view.maps.size() > 1 ? maps[i] : 0;
            depths.push_back(std::abs(depth_of(view.maps[map], point) - r));
        }
    }
    if (!lengths_m.empty()) {
        if (const double length_m = largest_but_few(lengths_m); !(length_m <= tolerance_m)) {
            return fmt::format("P at the pixels' centres: it is up to {:.3g} m beside the camera's "
                               "rays",
                               length_m);
        }
    }
    if (!depths.empty()) {
        if (const double depth = largest_but_few(depths); !(depth <= depth_tolerance)) {
            return fmt::format("the shadow map's frustum as it was: z.light differs from it by up "
                               "to {:.3g}",
                               depth);
        }
    }
    return {};
}

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
