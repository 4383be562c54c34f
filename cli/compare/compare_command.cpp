#include "cli/commands.hpp"

#include "analysis/metrics/binning.hpp"
#include "api/advice.hpp"
#include "api/compare.hpp"
#include "cli/compare/compare_outputs.hpp"
#include "cli/options/advice_options.hpp"
#include "cli/options/engine_option.hpp"
#include "cli/options/job_options.hpp"
#include "cli/options/output_files.hpp"
#include "cli/renderer/driven_renderer.hpp"
#include "cli/runs/comparison_recorder.hpp"
#include "cli/runs/watched_sweep.hpp"
#include "cli/system/announced_renderers.hpp"
#include "cli/system/progress.hpp"
#include "methods/job_method.hpp"
#include "reference_rt/truth.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

/// Refuses options that only GL supports.
void refuse_options_of_gl(const CompareOptions& options)
{
    refuse_for_renderer({{"--depth-map", !options.depth_map_path.empty()},
                         {"--heat-map", !options.heat_maps.empty()},
                         {"--view-depths", !options.view_depths_path.empty()},
                         {"--export-case", !options.case_folder.empty()},
                         {"--truth float", options.truth != "exact"},
                         {"--audit", options.audit},
                         {"--advise", options.advise},
                         {"--verify", options.verify},
                         {"--engine", !options.engine.empty()},
                         {"--device", options.session.device.has_value()}});
}

/// Compares another renderer's frame with the truth.
/// @throws scene::InputError  for options that only GL supports, and as `DrivenRenderer`.
void compare_renderer(const CompareOptions& options, RendererCommand command)
{
    refuse_options_of_gl(options);
    DrivenRenderer renderer{
        renderer_settings(std::move(command), options.renderer, options.session.threads)};
    const scene::JobSource source = read_driven_job(renderer, options.job);
    require_new_outputs(options, scene::light_jobs(source, options.job.case_name));
    note_ignored_cases("compare", options.job, source);
    const scene::SweepSpace space = space_of_one(source, options.job.case_name);
    api::SweepRunOptions settings;
    settings.folder = options.folder;
    settings.keeps_pixels = true;
    settings.allows_mixed = true;
    settings.may_replace = options.force;
    settings.job_text = job_text(options.job);
    settings.command = command_text("compare", options.job) + renderer_text(options.renderer);
    settings.compare_command = settings.command;
    std::optional<FrameRecorder> run;
    if (!options.folder.empty()) {
        run.emplace(space, settings);
        run->plan(renderer);
    }
    const scene::SweepPoint point = space.at(0);
    const analysis::Comparison comparison =
        renderer.compare(space.job(point), key_names(space.given_keys(point)));
    if (run) {
        run->record(0, comparison);
        (void)run->finish();
        announce_output("compare", options.folder);
    }
    renderer.close();
    write_outputs(options, {&comparison, 1});
}

/// "light sun: ", to begin a message; empty if there is one light.
std::string light_text(const analysis::Comparison& comparison)
{
    return comparison.light.empty() ? std::string{} : fmt::format("light {}: ", comparison.light);
}

/// @throws scene::EnvironmentError  if GL's triangle at a pixel cannot be explained.
void require_no_mismatch(const analysis::Comparison& comparison)
{
    const auto count = comparison.metrics.pixels.of(scene::ClassReason::mismatch);
    if (count > 0) {
        throw scene::EnvironmentError{fmt::format(
            "{}{} pixels mismatch: GL's triangle is neither a first hit nor explained by snapping "
            "or depth resolution; report it with the job and the output of `gnomon doctor`",
            light_text(comparison), count)};
    }
}

/// @throws scene::EnvironmentError  if verdicts contradict the critical biases.
void require_no_difference(const std::string& lookups, std::uint64_t differences,
                           std::uint64_t verdicts)
{
    if (differences > 0) {
        throw scene::EnvironmentError{fmt::format(
            "{} of {} verdicts of {} contradict the bias curve: its numbers do not "
            "hold for this driver; report it with the job and the output of `gnomon doctor`",
            differences, verdicts, lookups)};
    }
}

void require_no_difference(const analysis::Comparison& comparison)
{
    if (const auto& own = comparison.held) {
        require_no_difference(light_text(comparison) + "GL's lookup", own->differences,
                              own->lit + own->shadowed);
    }
    if (const auto& reruns = comparison.verification) {
        require_no_difference(light_text(comparison) + "GL's reruns", reruns->differences(),
                              reruns->verdicts());
    }
}

/// Refuses options that need the exact truth, or --advise.
void require_exact_truth(const CompareOptions& options)
{
    if (options.audit && options.truth != "exact") {
        throw scene::InputError{
            "--audit needs --truth exact: it counts where float methods differ"};
    }
    if (!options.folder.empty() && options.truth != "exact") {
        throw scene::InputError{"--out needs --truth exact: a run holds causes and bias curves"};
    }
    if (!options.case_folder.empty() && options.truth != "exact") {
        throw scene::InputError{"--export-case needs --truth exact: the case holds exact pixels "
                                "only"};
    }
    if (!options.heat_maps.empty() && options.truth != "exact") {
        throw scene::InputError{"--heat-map needs --truth exact: without it there are no causes"};
    }
    if (options.advise && options.truth != "exact") {
        throw scene::InputError{"--advise needs --truth exact: advice follows from the causes"};
    }
    if (options.advice.any() && !options.advise) {
        throw scene::InputError{
            "--views, --lights and --all-cases need --advise: they choose the views "
            "for the advice"};
    }
    if (method_request(options.methods) && !options.advise) {
        throw scene::InputError{"--methods needs --advise: it adds other methods to the advice"};
    }
    if (options.verify && options.truth != "exact") {
        throw scene::InputError{"--verify needs --truth exact: without it there is no bias curve"};
    }
    if (!options.engine.empty() && options.truth != "exact") {
        throw scene::InputError{
            "--engine needs --truth exact: without it there is no bias to recommend"};
    }
}

void verify(analysis::Comparison& comparison, const analysis::Renderers& renderers)
{
    comparison.verification = analysis::verify_comparison(comparison, renderers);
    if (!comparison.verification) {
        fmt::print(stderr, "gnomon: --verify: this lookup has no bias curve to compare GL with\n");
    }
}

/// Adds advice, and prints which methods were passed over.
void advise(analysis::Comparison& comparison, const analysis::ViewRequest& views,
            const api::ComparisonSession& session,
            const std::optional<analysis::MethodRequest>& methods)
{
    const std::string heading = fmt::format("gnomon compare: {}", light_text(comparison));
    api::advise(comparison, session, views, methods, method_progress(heading, false));
    if (comparison.methods_passed_over) {
        for (const analysis::PassedOverMethod& method : *comparison.methods_passed_over) {
            fmt::print(stderr, "{}{} was passed over: {}\n", heading, method.method, method.reason);
        }
    }
}

std::vector<analysis::Comparison> measure(const CompareOptions& options,
                                          std::span<const scene::LightJob> jobs,
                                          const api::ComparisonSession& session, SlowWork& work)
{
    const AnnouncedRenderers announced{session.renderers(), work};
    const analysis::Renderers& renderers = announced.renderers();
    const auto finish = [&](analysis::Comparison& comparison) {
        write_from_gl(options, comparison, session.file().defaults, renderers);
        if (options.audit) {
            comparison.float_audit = reference_rt::audit_float_methods(
                session.reference(), comparison.view, comparison.receivers.triangle,
                comparison.truth, options.session.threads);
        }
        if (options.verify) {
            work.now("verifying the bias curve");
            verify(comparison, renderers);
        }
    };
    return api::compare(session, jobs, {.renderers = &renderers, .finish = finish});
}

/// Requires that the method of at least one light has a map.
void require_a_map(std::span<const scene::LightJob> jobs)
{
    const auto has_map = [](const scene::LightJob& light) {
        return methods::traits(light.job).has_map;
    };
    if (std::ranges::none_of(jobs, has_map)) {
        throw scene::InputError(
            fmt::format("--depth-map: method.name = \"{}\" has no map: remove the option",
                        jobs.front().job.method.name));
    }
}

api::SessionOptions session_options(const CompareOptions& options)
{
    api::SessionOptions session = options.session;
    session.audits = options.audit;
    session.method = options.truth == "exact" ? reference_rt::TruthMethod::exact
                                              : reference_rt::TruthMethod::plain;
    return session;
}

/// Prints the recommended settings as --engine takes them.
void print_engine_settings(const reports::SettingsTarget& target,
                           std::span<const analysis::Comparison> lights)
{
    Translations translated{target, EngineBias::recommended};
    for (const analysis::Comparison& comparison : lights) {
        translated.add(comparison, comparison.light);
    }
    translated.print("compare");
}

void compare(const CompareOptions& options)
{
    const auto engine = engine_target(options.engine, options.json);
    if (auto renderer = chosen_renderer(options.renderer, options.job)) {
        compare_renderer(options, std::move(*renderer));
        return;
    }
    require_exact_truth(options);
    const scene::JobSource source = read_job_source(options.job);
    const auto jobs = scene::light_jobs(source, options.job.case_name);
    require_new_outputs(options, jobs);
    if (!options.depth_map_path.empty()) {
        require_a_map(jobs);
    }
    const auto methods = method_request(options.methods);
    if (options.advise && !methods) {
        api::require_advisable(jobs);
    }
    const auto views = view_requests(options.advice, options.job, source, jobs);
    if (!options.advice.all_cases) {
        note_ignored_cases("compare", options.job, source);
    }
    std::optional<ComparisonRecorder> run;
    if (!options.folder.empty()) {
        run.emplace(options.folder, options.force);
    }
    std::optional<SlowWork> work{std::in_place, "reading the scene"};
    const api::ComparisonSession session{jobs, session_options(options)};
    std::vector<analysis::Comparison> lights = measure(options, jobs, session, *work);
    for (std::size_t i = 0; options.advise && i < lights.size(); ++i) {
        work->now("trying remedies");
        advise(lights[i], views[i], session, methods);
    }
    work.reset();
    if (run) {
        run->record(source, options.job.case_name, lights, session.file().defaults,
                    job_text(options.job), command_text("compare", options.job));
        announce_output("compare", options.folder);
    }
    write_outputs(options, lights);
    if (engine) {
        print_engine_settings(*engine, lights);
    }
    for (const analysis::Comparison& comparison : lights) {
        require_no_mismatch(comparison);
        require_no_difference(comparison);
    }
}

void add_image_options(CLI::App& command, CompareOptions& options)
{
    command.add_option("--aov", options.aov_path,
                       "Write every layer into one EXR file (docs/aov.md)");
    command.add_option(
        "--picture", options.picture_path,
        "Write a labelled picture: GL's shadows, the true ones, the errors, those that "
        "the recommended bias leaves (PNG); "
        "of several lights this and what follows into a file each, FILE.LIGHT.png");
    command.add_option("--depth-map", options.depth_map_path,
                       "Write the shadow map, the light's view, into an EXR file (docs/aov.md)");
    command
        .add_option("--heat-map", options.heat_maps,
                    "NAME=FILE.png: a picture of needed-bias, depth-error, amount, cause or label, "
                    "with the same colours for the same values in every image; repeatable")
        ->allow_extra_args(false);
}

} // namespace

void add_compare_command(CLI::App& program)
{
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = program.add_subcommand(
        "compare", "Compare a scene's GL shadow map with shadow rays, pixel by pixel");
    add_job_options(*command, options->job);
    add_renderer_options(*command, options->renderer);
    command->add_flag("--json", options->json, "Print the result as JSON (docs/json_schema.md)");
    command->add_flag(
        "--verbose", options->verbose,
        "Print every number as tables: classes, causes, the bias curve, all remedies");
    add_engine_option(*command, options->engine,
                      "Also print the recommended shadow in the settings of an engine");
    add_image_options(*command, *options);
    CLI::Option* const view_depths = command->add_option(
        "--view-depths", options->view_depths_path,
        "Write the errors by view depth, the distance along the camera's axis, into a CSV file "
        "(docs/csv_schema.md)");
    command
        ->add_option("--view-depth-bands", options->view_depth_bands,
                     "How many bands of view depth it has")
        ->check(CLI::Range(1, analysis::Binning::most_bins))
        ->needs(view_depths)
        ->capture_default_str();
    command->add_option("--out", options->folder,
                        "RUN, a folder for the result with all its layers, as of `gnomon sweep`");
    command->add_option("--export-case", options->case_folder,
                        "DIR, a folder for GL's shadows as a case for `gnomon evaluate` "
                        "(docs/evaluate.md)");
    command->add_flag("--force", options->force,
                      "Let --export-case replace a case, and --out another scene's run or a sweep");
    command
        ->add_option("--truth", options->truth,
                     "exact: every scored pixel is proven; float: plain Embree rays, for comparing "
                     "speed")
        ->check(CLI::IsMember({"exact", "float"}))
        ->capture_default_str();
    command->add_flag("--audit", options->audit,
                      "Count the pixels that each usual float method for shadow rays gets wrong");
    command->add_flag(
        "--advise", options->advise,
        "Run GL again with the changes that suit the errors, and print what they give");
    add_advice_options(*command, options->advice);
    add_methods_option(*command, options->methods);
    command->add_flag("--verify", options->verify,
                      "Run GL again with biases that put the bias curve to the test, and compare "
                      "every verdict; exit status 4 if one differs");
    add_session_options(*command, options->session);
    command->footer("Examples:\n"
                    "  gnomon compare --builtin sphere-plane\n"
                    "  gnomon compare model.glb --set scene.ground=true --picture model.png\n"
                    "  gnomon compare job.toml --engine three\n"
                    "  gnomon compare job.toml --set shadow_map.resolution=2048 --json\n"
                    "  gnomon compare job.toml --case noon --aov noon.exr\n"
                    "  gnomon compare job.toml --advise --views 4\n"
                    "  gnomon compare job.toml --advise --methods pcf,evsm");
    command->callback([options] { compare(*options); });
}

} // namespace gnomon::cli
