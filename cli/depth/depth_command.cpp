#include "cli/commands.hpp"

#include "analysis/depth/depth_plan.hpp"
#include "cli/depth/depth_measure.hpp"
#include "cli/options/output_files.hpp"
#include "cli/system/standard_output.hpp"
#include "reports/depth/depth_comparison.hpp"
#include "reports/depth/depth_csv.hpp"
#include "reports/depth/depth_json.hpp"
#include "reports/depth/depth_plan_report.hpp"
#include "reports/depth/depth_plot.hpp"
#include "reports/depth/depth_table.hpp"
#include "scene/error.hpp"
#include "scene/settings/job.hpp"
#include "store/json_values.hpp"
#include "store/output_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

using analysis::DepthErrorRow;
using analysis::DepthStudy;

struct DepthOptions {
    std::optional<double> near_m;
    std::optional<double> far_m;
    std::optional<int> bits;
    std::string format;
    std::string content = "depth";
    std::string projection = "perspective";
    bool reversed = false;
    std::string clip;
    int samples = 4096;
    double tilt_deg = 0;
    double offset_m = 0;
    bool theory_only = false;
    bool plan = false;
    std::optional<double> max_error_m;
    std::optional<double> tolerance_m;
    bool compare = false;
    bool json = false;
    std::optional<std::string> csv_path; ///< "": standard output
    std::string plot_path;
    std::optional<int> device;
};

// The textbook lesson's frustum.
constexpr double default_near_m = 4;
constexpr double default_far_m = 50;
// Finer than double tells distances of a metre apart.
constexpr double smallest_tolerance_m = 1e-15;

scene::Projection projection_of(const DepthOptions& options)
{
    return options.projection == "perspective" ? scene::Projection::perspective
                                               : scene::Projection::orthographic;
}

/// What is even along the axis is an orthographic projection's depth, and needs no word of its own.
std::vector<std::string> studied_contents()
{
    std::vector<std::string> names;
    for (const scene::MapContentTraits& content : scene::map_contents()) {
        if (content.measure != scene::Measure::axis) {
            names.emplace_back(content.name);
        }
    }
    return names;
}

scene::MapContent content_of(const DepthOptions& options)
{
    return scene::map_content_from_name(options.content).value();
}

bool is_gl_depth(const DepthOptions& options)
{
    return traits_of(content_of(options)).is_gl_depth();
}

void require_range(const DepthOptions& options, double near_m, double far_m)
{
    constexpr double smallest_near_share = 1e-12;
    if (!(near_m < far_m) || !(std::abs(near_m) <= scene::max_coordinate_m) ||
        !(far_m <= scene::max_coordinate_m)) {
        throw scene::InputError(
            fmt::format("--near {} --far {}: near must be below far, both within ±{:g} m", near_m,
                        far_m, scene::max_coordinate_m));
    }
    if (options.projection == "perspective" && !(near_m >= smallest_near_share * far_m)) {
        throw scene::InputError(
            fmt::format("--near {}: of a perspective it must be above 0, at least {:g} of far",
                        near_m, smallest_near_share));
    }
}

void require_placement(const DepthOptions& options)
{
    if (!(options.tilt_deg >= 0 && options.tilt_deg <= scene::largest_plane_tilt_deg)) {
        throw scene::InputError(fmt::format("--tilt-deg {}: must be 0 to {}", options.tilt_deg,
                                            scene::largest_plane_tilt_deg));
    }
    if (!(std::abs(options.offset_m) <= scene::max_coordinate_m)) {
        throw scene::InputError(fmt::format("--offset {}: must be within ±{:g} m", options.offset_m,
                                            scene::max_coordinate_m));
    }
}

scene::MeasuredPlaneSettings planes_of(const DepthOptions& options)
{
    const double near_m = options.near_m.value_or(default_near_m);
    const double far_m = options.far_m.value_or(default_far_m);
    require_range(options, near_m, far_m);
    require_placement(options);
    const bool zero_to_one =
        options.clip.empty() ? options.reversed : options.clip == "zero_to_one";
    scene::MeasuredPlaneSettings planes;
    planes.range = {projection_of(options), near_m, far_m, options.reversed,
                    zero_to_one ? scene::ClipRange::zero_to_one
                                : scene::ClipRange::minus_one_to_one};
    planes.content = content_of(options);
    if (!is_gl_depth(options)) {
        planes.range.far_m = double{static_cast<float>(far_m)}; // GL divides by it
        require_range(options, near_m, planes.range.far_m);
    }
    planes.count = options.samples;
    planes.tilt_rad = options.tilt_deg * std::numbers::pi / 180;
    // What float32 cannot hold is not where the camera stands.
    planes.offset_m = double{static_cast<float>(options.offset_m)};
    return planes;
}

/// What GL says of itself; empty if nothing was measured.
struct Driver {
    std::string renderer;
    std::string version;
};

std::vector<DepthErrorRow> rows_of(const DepthStudy& study, std::size_t samples)
{
    if (study.measured) {
        return study.measured->rows;
    }
    return study.tolerance
               ? analysis::tolerance_rows(study.mapping, study.coding, samples, *study.tolerance)
               : analysis::formula_rows(study.mapping, study.coding, samples);
}

void print_study(const DepthOptions& options, DepthStudy study, const Driver& driver)
{
    if (options.tolerance_m) {
        study.tolerance =
            analysis::constant_tolerance(study.mapping, study.coding, *options.tolerance_m);
    }
    const auto rows = rows_of(study, static_cast<std::size_t>(options.samples));
    if (!options.plot_path.empty()) {
        reports::write_drawing(options.plot_path,
                               reports::depth_plot(study, rows, driver.renderer));
    }
    if (options.csv_path && !options.csv_path->empty()) {
        store::write_file(*options.csv_path, reports::depth_csv(study, rows));
    }
    if (options.csv_path && options.csv_path->empty()) {
        print(reports::depth_csv(study, rows));
    } else if (options.json) {
        print(reports::depth_json(study, rows, driver.renderer, driver.version));
    } else {
        print(reports::depth_table(study, rows, driver.renderer));
    }
}

void study(const DepthOptions& options)
{
    const DepthChoice choice = choose_format(options.format, options.bits);
    const scene::MeasuredPlaneSettings planes = planes_of(options);
    if (!choice.format || options.theory_only) {
        const std::string why = options.theory_only
                                    ? "--theory-only"
                                    : fmt::format("GL has no format of {}", choice.name);
        print_study(options, study_theory(choice, planes, why), {});
        return;
    }
    const raster_gl::Context context{options.device};
    const auto studies = study_formats(context, {choice}, planes);
    if (!studies.front().measured && !options.format.empty()) {
        throw scene::InputError(
            fmt::format("--format {}: {}; choose another, or pass --theory-only", options.format,
                        studies.front().not_measured_because));
    }
    print_study(options, studies.front(), {context.facts().renderer, context.facts().version});
}

std::vector<DepthChoice> all_formats()
{
    std::vector<DepthChoice> choices;
    for (const scene::DepthFormat format : scene::depth_formats()) {
        choices.push_back(choose_format(scene::depth_format_name(format), {}));
    }
    return choices;
}

/// Every format as asked, and reversed float if that was not asked for.
std::vector<DepthStudy> compared_formats(const DepthOptions& options,
                                         const raster_gl::Context* context)
{
    const auto studied = [&](const std::vector<DepthChoice>& choices,
                             const scene::MeasuredPlaneSettings& planes) {
        if (context != nullptr) {
            return study_formats(*context, choices, planes);
        }
        std::vector<DepthStudy> studies;
        for (const DepthChoice& choice : choices) {
            studies.push_back(study_theory(choice, planes, "--theory-only"));
        }
        return studies;
    };
    scene::MeasuredPlaneSettings planes = planes_of(options);
    std::vector<DepthStudy> studies = studied(all_formats(), planes);
    if (!options.reversed && is_gl_depth(options)) {
        planes.range.reversed = true;
        planes.range.clip_range = scene::ClipRange::zero_to_one;
        const auto reversed = studied({choose_format("d32f", {})}, planes);
        const auto floats = std::ranges::find(studies, "d32f", &DepthStudy::format);
        studies.insert(floats + 1, reversed.front());
    }
    return studies;
}

void compare(const DepthOptions& options)
{
    std::optional<raster_gl::Context> context;
    Driver driver;
    if (!options.theory_only) {
        context.emplace(options.device);
        driver = {context->facts().renderer, context->facts().version};
    }
    const auto studies = compared_formats(options, context ? &*context : nullptr);
    print(options.json ? reports::depth_comparison_json(studies, driver.renderer, driver.version)
                       : reports::depth_comparison_table(studies, driver.renderer));
}

void plan(const DepthOptions& options)
{
    if (!options.max_error_m || !options.far_m) {
        throw scene::InputError(
            "--plan needs both --max-error-m and --far: the error to keep, and up to "
            "which distance");
    }
    if (!(*options.max_error_m > 0) || !std::isfinite(*options.max_error_m)) {
        throw scene::InputError(
            fmt::format("--max-error-m {}: must be above 0", *options.max_error_m));
    }
    require_range(options, options.near_m.value_or(0.5 * *options.far_m), *options.far_m);
    const analysis::PlanTarget target{projection_of(options), *options.max_error_m, *options.far_m,
                                      options.near_m};
    const auto answers = analysis::plan_depth(target);
    print(options.json ? reports::depth_plan_json(target, answers)
                       : reports::depth_plan_text(target, answers));
}

void require_content(const DepthOptions& options)
{
    if (!is_gl_depth(options) && (options.plan || options.reversed || !options.clip.empty() ||
                                  options.projection != DepthOptions{}.projection)) {
        throw scene::InputError(fmt::format(
            "--content {} is about a light at a place, and no projection's depth: leave "
            "out --plan, --reversed, --clip and --projection",
            options.content));
    }
}

void require_consistent(const DepthOptions& options)
{
    require_content(options);
    if (options.plan || options.compare) {
        if (options.csv_path || !options.plot_path.empty() || options.bits || options.tolerance_m ||
            !options.format.empty()) {
            throw scene::InputError("--plan and --compare look at every format: leave out --bits, "
                                    "--format, --tolerance, --csv and --plot");
        }
    }
    const DepthOptions defaults;
    if (options.plan && (options.offset_m != 0 || options.tilt_deg != 0 || options.reversed ||
                         !options.clip.empty() || options.samples != defaults.samples)) {
        throw scene::InputError("--plan is about flat planes before a camera at the origin, in "
                                "both directions of depth: leave out --offset, --tilt-deg, "
                                "--reversed, --clip and --samples");
    }
    if (options.max_error_m && !options.plan) {
        throw scene::InputError("--max-error-m needs --plan");
    }
    if (options.tolerance_m && !(*options.tolerance_m >= smallest_tolerance_m &&
                                 *options.tolerance_m <= scene::max_coordinate_m)) {
        throw scene::InputError(fmt::format("--tolerance {}: must be {:g} to {:g} m",
                                            *options.tolerance_m, smallest_tolerance_m,
                                            scene::max_coordinate_m));
    }
    if (options.json && options.csv_path && options.csv_path->empty()) {
        throw scene::InputError(
            "--json and --csv both write to standard output: name a file, --csv FILE");
    }
    if (options.samples < 2 || options.samples > scene::most_measured_planes) {
        throw scene::InputError(fmt::format("--samples {}: must be 2 to {}", options.samples,
                                            scene::most_measured_planes));
    }
    require_outputs(
        std::array{OutputOption{"--plot", options.plot_path, store::OutputKind::plot},
                   OutputOption{"--csv", options.csv_path.value_or(""), store::OutputKind::csv}},
        {});
}

void run(const DepthOptions& options)
{
    require_consistent(options);
    if (options.plan) {
        plan(options);
    } else if (options.compare) {
        compare(options);
    } else {
        study(options);
    }
}

void add_frustum_options(CLI::App& command, DepthOptions& options)
{
    command.add_option("--near", options.near_m, "Near plane [m]; default 4");
    command.add_option("--far", options.far_m, "Far plane [m]; default 50");
    command
        .add_option("--content", options.content,
                    "What is stored: depth, or the distance to the light over far")
        ->check(CLI::IsMember(studied_contents()))
        ->capture_default_str();
    command.add_option("--projection", options.projection, "perspective or orthographic")
        ->check(CLI::IsMember({"perspective", "orthographic"}))
        ->capture_default_str();
    command.add_flag("--reversed", options.reversed, "Depth 1 at near, 0 at far");
    command
        .add_option("--clip", options.clip,
                    "Clip range; default: zero_to_one if reversed, else minus_one_to_one")
        ->check(CLI::IsMember({"minus_one_to_one", "zero_to_one"}));
}

void add_output_options(CLI::App& command, DepthOptions& options)
{
    command.add_flag("--json", options.json, "Print the result as JSON (docs/depth_precision.md)");
    command
        .add_option("--csv", options.csv_path, "Write the samples as CSV; without FILE, print it")
        ->expected(0, 1)
        ->type_name("[FILE]");
    command.add_option("--plot", options.plot_path,
                       "Draw error against distance into a .svg or .png file");
}

} // namespace

void add_depth_command(CLI::App& program)
{
    auto options = std::make_shared<DepthOptions>();
    CLI::App* command = program.add_subcommand(
        "depth", "Say how precisely depth is stored, by formula and as GL measures");
    add_frustum_options(*command, *options);
    auto* bits = command->add_option(
        "--bits", options->bits,
        "Evenly spaced codes of 8 to 32 bits: d16, d24, d32, else written by the shader (25 to 31: "
        "theory only); default 24");
    command->add_option("--format", options->format, scene::depth_format_listing())->excludes(bits);
    command->add_option("--samples", options->samples, "Planes to measure, from near to far")
        ->capture_default_str();
    command->add_option("--tilt-deg", options->tilt_deg, "Tilt of the planes, 0 to 80")
        ->capture_default_str();
    command
        ->add_option("--offset", options->offset_m,
                     "How far from the world's origin the camera stands, on each axis [m]")
        ->capture_default_str();
    command->add_flag("--theory-only", options->theory_only, "Do not use GL");
    auto* compare_flag =
        command->add_flag("--compare", options->compare, "All formats for one frustum");
    command->add_flag("--plan", options->plan, "Which near plane and format meet a target error")
        ->excludes(compare_flag);
    command->add_option("--max-error-m", options->max_error_m,
                        "With --plan: the largest error, up to --far [m]");
    command->add_option("--tolerance", options->tolerance_m,
                        "A constant tolerance to hold against the format's error [m]; with "
                        "--theory-only the samples show single codes, too");
    add_output_options(*command, *options);
    command->add_option("--device", options->device, "Use this EGL device (see `gnomon doctor`)");
    command->footer(
        "Examples:\n"
        "  gnomon depth --near 4 --far 50 --bits 16\n"
        "  gnomon depth --near 0.1 --far 1000 --format d32f --reversed --plot error.png\n"
        "  gnomon depth --bits 32 --tolerance 1e-8 --theory-only --plot tolerance.svg\n"
        "  gnomon depth --far 20 --format rgba8 --content distance --plot packed.svg\n"
        "  gnomon depth --near 0.5 --far 200 --compare\n"
        "  gnomon depth --plan --max-error-m 0.01 --far 200");
    command->callback([options] { run(*options); });
}

} // namespace gnomon::cli
