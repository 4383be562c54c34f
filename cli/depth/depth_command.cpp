#include "cli/commands.hpp"

#include "analysis/depth/depth_plan.hpp"
#include "api/depth_study.hpp"
#include "cli/options/output_files.hpp"
#include "cli/system/process.hpp"
#include "reports/depth/depth_parts.hpp"
#include "reports/depth/depth_report.hpp"
#include "scene/error.hpp"
#include "store/output_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace gnomon::cli {
namespace {

struct DepthOptions {
    api::DepthRequest request;
    std::optional<int> bits;
    std::string format;
    std::string content = "depth";
    std::string projection = "perspective";
    std::string clip;
    bool theory_only = false;
    bool plan = false;
    std::optional<double> max_error_m;
    bool compare = false;
    bool json = false;
    std::optional<std::string> csv_path; ///< "": standard output
    std::string plot_path;
    std::optional<int> device;
};

/// The request, with the options that are names.
api::DepthRequest request_of(const DepthOptions& options)
{
    api::DepthRequest request = options.request;
    request.content = scene::map_content_from_name(options.content).value();
    request.projection = options.projection == "perspective" ? scene::Projection::perspective
                                                             : scene::Projection::orthographic;
    if (!options.clip.empty()) {
        request.clip_range = options.clip == "zero_to_one" ? scene::ClipRange::zero_to_one
                                                           : scene::ClipRange::minus_one_to_one;
    }
    return request;
}

void print_study(const DepthOptions& options, const api::StudiedDepth& found)
{
    const auto& [study, rows, driver] = found;
    if (!options.plot_path.empty()) {
        reports::write_drawing(options.plot_path,
                               reports::depth_plot(study, rows, driver.renderer));
        announce_output("depth", options.plot_path);
    }
    if (options.csv_path && !options.csv_path->empty()) {
        store::write_file(*options.csv_path, reports::depth_csv(study, rows));
        announce_output("depth", *options.csv_path);
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
    const api::DepthChoice choice = api::choose_format(options.format, options.bits);
    const api::DepthRequest request = request_of(options);
    if (!choice.format || options.theory_only) {
        const std::string why = options.theory_only
                                    ? "--theory-only"
                                    : fmt::format("GL has no format of {}", choice.name);
        print_study(options, api::study_depth(request, choice, nullptr, why));
        return;
    }
    const raster_gl::Context context{options.device};
    print_study(options, api::study_depth(request, choice, &context));
}

void compare(const DepthOptions& options)
{
    std::optional<raster_gl::Context> context;
    api::DepthDriver driver;
    if (!options.theory_only) {
        context.emplace(options.device);
        driver = {context->facts().renderer, context->facts().version};
    }
    const auto studies =
        api::study_all_formats(request_of(options), context ? &*context : nullptr, "--theory-only");
    print(options.json ? reports::depth_comparison_json(studies, driver.renderer, driver.version)
                       : reports::depth_comparison_table(studies, driver.renderer));
}

void plan(const DepthOptions& options)
{
    if (!options.max_error_m || !options.request.far_m) {
        throw scene::InputError(
            "--plan needs --max-error-m and --far: the largest error, and the distance up to "
            "which it must hold");
    }
    const analysis::PlanTarget target = api::plan_target(request_of(options), *options.max_error_m);
    const auto answers = analysis::plan_depth(target);
    print(options.json ? reports::depth_plan_json(target, answers)
                       : reports::depth_plan_text(target, answers));
}

void require_consistent(const DepthOptions& options)
{
    const api::DepthRequest& request = options.request;
    if (options.plan && options.content != DepthOptions{}.content) {
        throw scene::InputError(fmt::format("--content {} is for a light's position, not for a "
                                            "projection's depth: remove --plan",
                                            options.content));
    }
    if (options.plan || options.compare) {
        if (options.csv_path || !options.plot_path.empty() || options.bits || request.tolerance_m ||
            !options.format.empty()) {
            throw scene::InputError(
                "--plan and --compare use every format: remove --bits, --format, "
                "--tolerance, --csv and --plot");
        }
    }
    if (options.plan && (request.offset_m != 0 || request.tilt_deg != 0 || request.reversed ||
                         !options.clip.empty() || request.samples != api::DepthRequest{}.samples)) {
        throw scene::InputError(
            "--plan assumes planes that face a camera at the origin, for normal "
            "and reversed depth: remove --offset, --tilt-deg, --reversed, --clip "
            "and --samples");
    }
    if (options.max_error_m && !options.plan) {
        throw scene::InputError("--max-error-m needs --plan");
    }
    if (!options.plan) {
        api::require_sound(request_of(options));
    }
    if (options.json && options.csv_path && options.csv_path->empty()) {
        throw scene::InputError(
            "--json and --csv both write to standard output: name a file, --csv FILE");
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
    command.add_option("--near", options.request.near_m, "Near plane [m]; default 4");
    command.add_option("--far", options.request.far_m, "Far plane [m]; default 50");
    command
        .add_option("--content", options.content,
                    "What is stored: depth, or the distance to the light over far")
        ->check(CLI::IsMember(api::studied_contents()))
        ->capture_default_str();
    command.add_option("--projection", options.projection, "perspective or orthographic")
        ->check(CLI::IsMember({"perspective", "orthographic"}))
        ->capture_default_str();
    command.add_flag("--reversed", options.request.reversed, "Depth 1 at near, 0 at far");
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
    command
        ->add_option("--samples", options->request.samples, "Planes to measure, from near to far")
        ->capture_default_str();
    command->add_option("--tilt-deg", options->request.tilt_deg, "Tilt of the planes, 0 to 80")
        ->capture_default_str();
    command
        ->add_option("--offset", options->request.offset_m,
                     "How far from the world's origin the camera stands, on each axis [m]")
        ->capture_default_str();
    command->add_flag("--theory-only", options->theory_only, "Do not use GL");
    auto* compare_flag =
        command->add_flag("--compare", options->compare, "All formats for one frustum");
    command->add_flag("--plan", options->plan, "Which near plane and format meet a target error")
        ->excludes(compare_flag);
    command->add_option("--max-error-m", options->max_error_m,
                        "With --plan: the largest error, up to --far [m]");
    command->add_option("--tolerance", options->request.tolerance_m,
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
