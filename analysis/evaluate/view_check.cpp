#include "analysis/evaluate/view_check.hpp"

#include "analysis/depth/depth_mapping.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "methods/job_method.hpp"
#include "scene/camera/camera.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace gnomon::analysis {

namespace {

using scene::Vec3d;
using scene::View;

bool is_judged_point(const scene::Vec3f& p)
{
    return !std::isnan(p.x);
}

/// The share of 99 % of the values; they are not empty.
double largest_but_few(std::vector<double>& values)
{
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

/// What the map stores of a point.
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

/// How far P is from the ray of a pixel, as a share of its distance.
double share_off_ray(const View& view, const Vec3d& point, int x, int y)
{
    const scene::Ray ray = scene::pixel_ray(view.camera, view.image, x, y);
    const Vec3d to_point = point - ray.origin;
    const double length = glm::length(to_point) * glm::length(ray.direction);
    const double across = glm::length(glm::cross(to_point, ray.direction));
    // A ray begins at its origin: behind it no pixel sees anything.
    return glm::dot(to_point, ray.direction) > 0 ? across / length : 2.0;
}

/// The median over some pixels, with the image read in another order.
double median_off_ray(const View& view, const scene::CaseLayers& layers, bool rows, bool columns)
{
    const auto [width, height] = view.image;
    std::vector<double> shares;
    const int step = std::max(
        1, static_cast<int>(std::sqrt(static_cast<double>(view.image.pixel_count()) / 4096)));
    for (int y = 0; y < height; y += step) {
        for (int x = 0; x < width; x += step) {
            if (is_judged_point(layers.position(x, y))) {
                shares.push_back(share_off_ray(view, Vec3d{layers.position(x, y)},
                                               columns ? width - 1 - x : x,
                                               rows ? height - 1 - y : y));
            }
        }
    }
    if (shares.empty()) {
        return 0;
    }
    const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
    std::nth_element(shares.begin(), middle, shares.end());
    return *middle;
}

/// Whether the file says that a key is this word.
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
                                        const methods::LookupTraits& promised,
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
    need(promised.has_one_tap() || !layers.map_depths.empty(), "map.file");
    need(!promised.scatters_taps() || !layers.kernel_axes.empty(),
         "kernel_axis.X and kernel_axis.Y");
    return missing;
}

} // namespace

std::vector<std::string> missing_for_causes(const scene::CaseFile& file, const scene::Job& job,
                                            const scene::CaseLayers& layers)
{
    // What the method promises of one map: that maps are mixed is told apart, below.
    const methods::LookupTraits promised = methods::method_of(job).traits(job);
    if (!promised.compares_depths() || promised.reads != methods::Reads::footprint) {
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
    for (std::string& layer : missing_layers(file, promised, layers)) {
        missing.push_back(std::move(layer));
    }
    if (file.space.is_mirrored() || file.space.metres_per_unit != 1) {
        missing.emplace_back("right-handed axes and metres");
    }
    if (mixes_maps(file)) { // of mixed verdicts GL's own lookups tell the causes
        missing.emplace_back("shadow_map.blend = 0");
    }
    return missing;
}

std::string find_disagreement(const View& view, const scene::CaseLayers& layers,
                              const scene::TriangleScene& triangles,
                              const scene::Image<std::uint32_t>& receivers, double tolerance_m)
{
    // Depths of float32 matrices and positions; what another projection or range gives is far off.
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

std::optional<ImportMistake> check_camera(const View& view, const scene::CaseLayers& layers)
{
    // Half a pixel's opening angle, and much less than any flip but of a few rows makes.
    const double pixel = view.camera.half_height / view.image.height_px;
    if (view.camera.projection != scene::Projection::perspective ||
        median_off_ray(view, layers, false, false) <= 2 * pixel) {
        return std::nullopt;
    }
    for (const auto& [rows, columns, words] : {std::tuple{true, false, "rows"},
                                               {false, true, "columns"},
                                               {true, true, "rows and columns"}}) {
        if (median_off_ray(view, layers, rows, columns) <= 2 * pixel) {
            return ImportMistake{"flipped_image",
                                 fmt::format("the image is flipped against the camera: its {} are "
                                             "in the opposite order; an image begins at its top "
                                             "left",
                                             words)};
        }
    }
    return std::nullopt;
}

} // namespace gnomon::analysis
