#include "reports/text/description.hpp"

#include "analysis/pixels/maps_of_pixels.hpp"
#include "methods/job_method.hpp"
#include "reports/text/text.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::reports {

namespace {

std::string describe_size(const analysis::SceneSummary& scene)
{
    return fmt::format("{}, {}", counted(scene.triangles, "triangle"),
                       counted(scene.objects, "object"));
}

std::string describe_light(const scene::Light& light)
{
    if (!light.has_position()) {
        const scene::Vec3d& d = light.direction;
        return fmt::format("directional ({:.4g}, {:.4g}, {:.4g})", d.x, d.y, d.z);
    }
    if (light.shines_all_round()) {
        const scene::Vec3d& p = light.position;
        return fmt::format("point at ({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z);
    }
    constexpr double deg_from_rad = 180 / std::numbers::pi;
    return fmt::format("spot, cone {:.4g} deg", 2 * std::acos(light.cos_half_cone) * deg_from_rad);
}

std::string describe_content(const scene::MapContentTraits& content)
{
    return content.is_gl_depth() ? std::string{} : fmt::format(", {}", content.noun);
}

std::string describe_map(const scene::Job& job)
{
    const scene::ShadowMapSettings& map = job.shadow_map;
    const std::string size = fmt::format("{0}x{0} {1}{2}", map.resolution_texels,
                                         scene::depth_format_name(map.depth_format),
                                         describe_content(traits_of(map.frustum.content)));
    const scene::MapLayout layout = scene::map_layout(job);
    return layout == scene::MapLayout::single
               ? fmt::format("{}, fit {}", size, scene::fit_name(map.frustum.fit))
               : fmt::format("{} of {}, {}", scene::map_count(job), size,
                             scene::map_layout_name(layout));
}

/// For several maps, from the nearest near plane to the farthest far plane.
std::string describe_range(std::span<const scene::LightFrustum> maps, scene::Cull cull,
                           std::string_view unit)
{
    const double near_m = std::ranges::min(maps, {}, &scene::LightFrustum::near_m).near_m;
    const double far_m = std::ranges::max(maps, {}, &scene::LightFrustum::far_m).far_m;
    return fmt::format("near {:.4g} {}, far {:.4g} {}, cull {}{}", near_m, unit, far_m, unit,
                       scene::cull_name(cull), maps.front().reversed ? ", reversed" : "");
}

/// Whether the job's method reads the table.
bool reads(const scene::Job& job, std::string_view table)
{
    const auto tables = methods::method_of(job).key_tables;
    return std::ranges::find(tables, table) != tables.end();
}

/// "constant 0.0005", "slope 0", "normal 0 texels": all three, then the other terms that are set.
/// @param digits  significant ones, at most.
std::vector<std::string> bias_terms(const scene::Job& job, const scene::Bias& bias,
                                    std::string_view unit, int digits)
{
    const scene::BiasUnit& given = scene::bias_unit_of(job.bias);
    const std::string in_unit =
        given.is_depth() ? std::string{}
                         : fmt::format(" ({:.{}g} {})", scene::constant_in_unit(job.bias), digits,
                                       given.symbol == "m" ? unit : given.symbol);
    std::vector<std::string> terms{
        fmt::format("constant {:.{}g}{}", plain_zero(bias.constant), digits, in_unit),
        fmt::format("slope {:.{}g}", plain_zero(bias.slope), digits),
        fmt::format("normal {:.{}g} texels", plain_zero(bias.normal_texels), digits)};
    for (const auto& [key, value] : bias.added) {
        if (value != 0) {
            terms.push_back(fmt::format("{} {:.{}g}", scene::key_leaf(key), value, digits));
        }
    }
    for (const auto& [key, value] : job.method.values) {
        const auto* word = std::get_if<std::string>(&value);
        if (word != nullptr && *word != "off" && key.starts_with("bias.")) {
            terms.push_back(fmt::format("{} {}", scene::key_leaf(key), *word));
        }
    }
    return terms;
}

/// The filter, or a method without filters and its settings.
std::string lookup_name(const scene::Job& job)
{
    const methods::Method& method = methods::method_of(job);
    if (!method.filters.empty()) {
        return std::string{scene::filter_name(job.lookup.filter)};
    }
    std::string text{method.name};
    for (const scene::Key& key : method.keys) {
        const scene::JobValue& value = key.value_of(job.method);
        if (value == key.default_value) {
            continue; // a picture has no room for all keys
        }
        const auto* word = std::get_if<std::string>(&value);
        text += fmt::format(", {} {}", scene::key_leaf(key.name),
                            word != nullptr ? *word : scene::to_toml(value));
    }
    return text;
}

} // namespace

std::string_view length_unit(const analysis::Comparison& comparison)
{
    return comparison.evaluation ? "m" : scene::length_unit(comparison.job.scene);
}

Description describe(const analysis::Comparison& comparison)
{
    const scene::Job& job = comparison.job;
    const scene::View& view = comparison.view;
    const bool has_map = methods::traits(job).has_map;
    const std::string outside =
        reads(job, "lookup") ? fmt::format(", outside {}", scene::outside_name(job.lookup.outside))
                             : std::string{};
    return {
        .size = describe_size(comparison.scene),
        .light = describe_light(view.light),
        .map = has_map ? describe_map(job) : "none",
        .range = has_map && !view.maps.empty()
                     ? describe_range(view.maps, job.shadow_map.cull, length_unit(comparison))
                     : std::string{},
        .lookup = lookup_name(job) + outside,
        .bias =
            reads(job, "bias")
                ? fmt::format(
                      "{}", fmt::join(bias_terms(job, view.bias, length_unit(comparison), 4), ", "))
                : "none",
        .image = fmt::format("{}x{}", view.image.width_px, view.image.height_px),
    };
}

std::string renderer_in_brief(const analysis::Comparison& comparison)
{
    const std::string& name = comparison.environment.gl_renderer;
    return name.substr(0, name.find(" ("));
}

std::string bias_in_brief(const analysis::Comparison& comparison)
{
    const scene::Job& job = comparison.job;
    std::vector<std::string> terms =
        reads(job, "bias") ? bias_terms(job, comparison.view.bias, length_unit(comparison), 3)
                           : std::vector<std::string>{};
    std::erase_if(terms, [](const std::string& term) {
        return term == "constant 0" || term.starts_with("constant 0 (") || term == "slope 0" ||
               term == "normal 0 texels";
    });
    return terms.empty() ? "no bias" : fmt::format("bias {}", fmt::join(terms, ", "));
}

std::string settings_in_brief(const analysis::Comparison& comparison)
{
    const scene::Job& job = comparison.job;
    std::vector<std::string> parts;
    if (methods::traits(job).has_map) {
        parts.push_back("map " + describe_map(job));
    }
    parts.push_back(lookup_name(job));
    if (reads(job, "bias")) {
        parts.push_back(bias_in_brief(comparison));
    }
    const scene::ImageSize image = comparison.view.image;
    parts.push_back(fmt::format("image {}x{}", image.width_px, image.height_px));
    parts.push_back(renderer_in_brief(comparison));
    return fmt::format("{}", fmt::join(parts, "; "));
}

std::string verification_text(const analysis::BiasVerification& found)
{
    return fmt::format("{} of GL: {} of {} differ", counted(found.reruns.size(), "rerun"),
                       grouped(found.differences()), counted(found.verdicts(), "verdict"));
}

std::string map_of_lengths(const analysis::Comparison& comparison)
{
    return scene::map_layout(comparison.job) == scene::MapLayout::cascades
               ? fmt::format(" in cascade {}",
                             comparison.view.map_name(analysis::most_read_map(
                                 comparison.lookup.maps, comparison.truth.pixel_class)))
               : "";
}

} // namespace gnomon::reports
