#include "cli/compare/compare_outputs.hpp"

#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/taps.hpp"
#include "api/compare.hpp"
#include "cli/options/output_files.hpp"
#include "cli/system/process.hpp"
#include "cli/system/terminal.hpp"
#include "methods/job_method.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/pictures/heat_map.hpp"
#include "reports/pictures/picture.hpp"
#include "reports/tables/comparison_table.hpp"
#include "reports/text/answer.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/view/view.hpp"
#include "store/case/case_files.hpp"
#include "store/csv/view_depth_csv.hpp"
#include "store/exr/aov.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;
using store::OutputKind;

struct HeatMapFile {
    reports::HeatMap kind;
    std::string path;
};

std::vector<HeatMapFile> heat_map_files(const CompareOptions& options)
{
    std::vector<HeatMapFile> files;
    for (const std::string& text : options.heat_maps) {
        const std::size_t equals = text.find('=');
        const auto kind = reports::heat_map_from_name(text.substr(0, equals));
        if (!kind || equals == std::string::npos || equals + 1 == text.size()) {
            throw scene::InputError(
                fmt::format("--heat-map {}: must be NAME=FILE.png with NAME one of {}", text,
                            fmt::join(reports::heat_map_names(), ", ")));
        }
        files.push_back({*kind, text.substr(equals + 1)});
    }
    return files;
}

/// The file for one of several lights: "shadows.sun.png" for "shadows.png".
std::string file_of_light(const std::string& path, const std::string& light)
{
    if (path.empty() || light.empty()) {
        return path;
    }
    fs::path file{path};
    file.replace_extension(light + file.extension().string());
    return file.string();
}

/// The folder for one of several lights: "case/sun" for "case".
fs::path folder_of_light(const std::string& folder, const std::string& light)
{
    return light.empty() ? fs::path{folder} : fs::path{folder} / light;
}

std::vector<OutputOption> outputs(const CompareOptions& options,
                                  std::span<const scene::LightJob> jobs)
{
    std::vector<OutputOption> all{{"--aov", options.aov_path, OutputKind::layers}};
    const auto heat_maps = heat_map_files(options);
    for (const auto& [light, job] : jobs) {
        all.push_back(
            {"--picture", file_of_light(options.picture_path, light), OutputKind::picture});
        all.push_back(
            {"--depth-map", file_of_light(options.depth_map_path, light), OutputKind::layers});
        all.push_back(
            {"--view-depths", file_of_light(options.view_depths_path, light), OutputKind::csv});
        for (const HeatMapFile& file : heat_maps) {
            all.push_back({"--heat-map", file_of_light(file.path, light), OutputKind::picture});
        }
    }
    return all;
}

/// Says that one of the command's files was written.
void announce(const fs::path& file)
{
    announce_output("compare", file);
}

void write_layers(const std::string& path, std::span<const analysis::Comparison> lights)
{
    const auto points = api::points_of(lights.front()); // they do not depend on the light
    if (lights.front().light.empty()) {
        store::write_aov(path, lights.front(), points);
    } else {
        store::write_aov(path, lights, points);
    }
    announce(path);
}

void write_view_depths(const CompareOptions& options, const analysis::Comparison& comparison)
{
    if (options.view_depths_path.empty()) {
        return;
    }
    const std::string file = file_of_light(options.view_depths_path, comparison.light);
    store::write_file(file, store::view_depth_csv(comparison, options.view_depth_bands));
    announce(file);
}

void write_pictures(const CompareOptions& options, const analysis::Comparison& comparison)
{
    const std::string& light = comparison.light;
    if (!options.picture_path.empty()) {
        const std::string file = file_of_light(options.picture_path, light);
        reports::write_picture(file, comparison);
        announce(file);
    }
    for (const HeatMapFile& heat_map : heat_map_files(options)) {
        const std::string file = file_of_light(heat_map.path, light);
        reports::write_heat_map(file, comparison, heat_map.kind);
        announce(file);
    }
}

std::string result_text(const CompareOptions& options, std::span<const analysis::Comparison> lights)
{
    const bool is_one = lights.front().light.empty();
    if (options.json) {
        return is_one ? reports::comparison_json(lights.front()) : reports::comparison_json(lights);
    }
    if (options.verbose) {
        return is_one ? reports::comparison_table(lights.front()) : reports::lights_table(lights);
    }
    const bool may_translate = options.engine.empty() && !lights.front().evaluation;
    const reports::AnswerOptions answer{stdout_has_colours(),
                                        may_translate ? command_text("settings", options.job)
                                                      : std::string{}};
    return is_one ? reports::answer_text(lights.front(), answer)
                  : reports::answer_text(lights, answer);
}

/// Writes GL's verdict as another renderer's case (docs/evaluate.md). Draws the map, and looks it
/// up, once more.
void export_case(const std::filesystem::path& folder, const analysis::Comparison& comparison,
                 const scene::SceneDefaults& defaults, const analysis::Renderers& renderers)
{
    const scene::Job& job = comparison.job;
    store::CaseExtras extras{api::points_of(comparison),
                             scene::resolve_camera(job, *comparison.triangles, defaults),
                             scene::resolve_light(job, defaults),
                             {},
                             {}};
    renderers::Rasterizer& rasterizer = renderers.rasterizer;
    const renderers::Drawn drawn{rasterizer.draw_receivers(comparison.view),
                                 renderers::draw_filtered_map(rasterizer, job, comparison.view)};
    if (!methods::traits(job).has_one_tap()) {
        extras.map_depths = drawn.map->map().depths();
    }
    if (!analysis::can_derive_unbiased(job, comparison.view)) {
        scene::View unbiased = comparison.view;
        unbiased.bias = {};
        extras.unmoved = rasterizer.look_up({drawn, job, unbiased});
    }
    store::write_case(folder, comparison, extras);
}

} // namespace

void require_new_outputs(const CompareOptions& options, std::span<const scene::LightJob> jobs)
{
    const InputFile job{"JOB", options.job.job_path};
    require_outputs(outputs(options, jobs), {&job, 1});
    if (options.case_folder.empty()) {
        return;
    }
    for (const scene::LightJob& each : jobs) {
        for (const std::string_view name : store::case_files()) {
            require_absent(folder_of_light(options.case_folder, each.light) / name, options.force,
                           "name another folder");
        }
    }
}

void write_from_gl(const CompareOptions& options, const analysis::Comparison& comparison,
                   const scene::SceneDefaults& defaults, const analysis::Renderers& renderers)
{
    const std::string& light = comparison.light;
    if (!options.depth_map_path.empty() && methods::traits(comparison.job).has_map) {
        const auto map = renderers.rasterizer.draw_map(comparison.job, comparison.view, {});
        const std::string file = file_of_light(options.depth_map_path, light);
        store::write_depth_map(file, comparison, map->depths());
        announce(file);
    }
    if (!options.case_folder.empty()) {
        const fs::path folder = folder_of_light(options.case_folder, light);
        export_case(folder, comparison, defaults, renderers);
        announce(folder);
    }
}

void write_outputs(const CompareOptions& options, std::span<const analysis::Comparison> lights)
{
    if (!options.aov_path.empty()) {
        write_layers(options.aov_path, lights);
    }
    for (const analysis::Comparison& comparison : lights) {
        write_pictures(options, comparison);
        write_view_depths(options, comparison);
    }
    print(result_text(options, lights));
}

} // namespace gnomon::cli
