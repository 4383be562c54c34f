#include "cli/commands.hpp"

#include "analysis/stopwatch.hpp"
#include "api/compare.hpp"
#include "api/tune.hpp"
#include "cli/exit_codes.hpp"
#include "cli/options/advice_options.hpp"
#include "cli/options/engine_option.hpp"
#include "cli/options/job_options.hpp"
#include "cli/renderer/driven_renderer.hpp"
#include "cli/system/process.hpp"
#include "cli/tune/tune_renderer.hpp"
#include "reports/tune/tune_report.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

struct TuneOptions {
    JobOptions job;
    RendererOptions renderer;
    std::size_t budget = 120;
    bool has_limits = false; ///< any --max-… is given
    api::SessionOptions session;
    std::optional<std::string> max_false_shadow;
    std::optional<std::string> max_false_lit;
    std::string max_false_shadow_count = "100%";
    std::string max_false_lit_count = "100%";
    int max_resolution = 4096;
    double time_s = analysis::TuneGoal{}.time_s;
    bool has_time = false; ///< --time is given
    bool json = false;
    bool verbose = false;
    bool quiet = false;
    std::string engine; ///< empty: not given
    api::ViewOptions advice;
    MethodsOption methods;
};

/// "0.1%" or "0.001" as a fraction.
double read_rate(std::string_view option, const std::string& text)
{
    const bool is_percent = text.ends_with('%');
    double value = 0;
    const char* const end = text.data() + text.size() - (is_percent ? 1 : 0);
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const double rate = is_percent ? value / 100 : value;
    if (error != std::errc{} || stop != end || !(rate >= 0 && rate <= 1)) {
        throw scene::InputError(fmt::format(
            "{} {}: must be a share from 0 to 1, or from 0% to 100%, e.g. 0.1%", option, text));
    }
    return rate;
}

analysis::TuneGoal tune_goal(const TuneOptions& options)
{
    const auto rate = [](const char* option, const std::optional<std::string>& text) {
        return text ? std::optional{read_rate(option, *text)} : std::nullopt;
    };
    return {rate("--max-false-shadow", options.max_false_shadow),
            rate("--max-false-lit", options.max_false_lit),
            read_rate("--max-false-shadow-count", options.max_false_shadow_count),
            read_rate("--max-false-lit-count", options.max_false_lit_count),
            options.max_resolution,
            options.time_s,
            analysis::started_clock()};
}

reports::TuneDetail detail_of(const TuneOptions& options)
{
    if (options.quiet) {
        return reports::TuneDetail::answer;
    }
    return options.verbose ? reports::TuneDetail::tried : reports::TuneDetail::found;
}

/// Prints the progress of a search to stderr.
api::TuneWatcher watcher_of(const TuneOptions& options)
{
    if (options.quiet) {
        return {};
    }
    const auto heading = [](const std::string& light) {
        return light.empty() ? std::string{"gnomon tune: "}
                             : fmt::format("gnomon tune: light {}: ", light);
    };
    const auto tell = [heading, &options, told = std::set<std::string>{}](
                          const std::string& light, const analysis::TunedSetting& setting) mutable {
        if (options.verbose) {
            fmt::print(stderr, "{}{}\n", heading(light), reports::tuned_setting_line(setting));
        } else if (told.insert(light).second) {
            fmt::print(stderr, "{}searching for up to {:g} s\n", heading(light), options.time_s);
        }
    };
    return {tell, [heading, &options](const std::string& light) {
                return method_progress(heading(light), options.verbose);
            }};
}

/// The options for another renderer's search.
RendererTuneOptions renderer_tune_options(const TuneOptions& options)
{
    refuse_for_renderer({{"--max-…", options.has_limits},
                         {"--time", options.has_time},
                         {"--views, --lights and --all-cases", options.advice.any()},
                         {"--methods and --max-bytes",
                          !options.methods.names.empty() || options.methods.max_bytes.has_value()},
                         {"--device", options.session.device.has_value()},
                         {"--engine", !options.engine.empty()}});
    return {options.job,  options.renderer, options.budget, options.session.threads,
            options.json, options.quiet,    options.verbose};
}

/// Prints the settings that were found as --engine takes them.
void print_engine_settings(const reports::SettingsTarget& target,
                           std::span<const reports::TunedLight> lights)
{
    Translations translated{target, EngineBias::found};
    for (const reports::TunedLight& tuned : lights) {
        if (tuned.result.recommends()) {
            translated.add(tuned.result.measured, tuned.light);
        }
    }
    translated.print("tune");
}

void tune(const TuneOptions& options)
{
    const auto engine = engine_target(options.engine, options.json);
    if (auto renderer = chosen_renderer(options.renderer, options.job)) {
        tune_renderer(renderer_tune_options(options), std::move(*renderer));
        return;
    }
    const api::TuneRequest request{tune_goal(options), method_request(options.methods)};
    if (options.has_time && !options.methods.names.empty()) {
        throw scene::InputError(
            "--time and --methods are mutually exclusive: a search over methods "
            "tries all settings");
    }
    const scene::JobSource source = read_job_source(options.job);
    const auto jobs = scene::light_jobs(source, options.job.case_name);
    if (!request.methods) {
        api::require_tunable(jobs);
    }
    const auto views = view_requests(options.advice, options.job, source, jobs);
    if (!options.advice.all_cases) {
        note_ignored_cases("tune", options.job, source);
    }
    const api::ComparisonSession session{jobs, options.session};
    const auto lights = api::tune(session, jobs, views, request, watcher_of(options));
    print(options.json ? reports::tune_json(lights)
                       : reports::tune_text(lights, detail_of(options)));
    if (engine) {
        print_engine_settings(*engine, lights);
    }
    if (!std::ranges::all_of(
            lights, [](const reports::TunedLight& tuned) { return tuned.result.meets_limits(); })) {
        throw CLI::RuntimeError{exit_codes::negative};
    }
}

void add_limit_options(CLI::App& command, TuneOptions& options)
{
    command.add_option("--max-false-shadow", options.max_false_shadow,
                       "Largest amount of shadow on lit pixels, as a share of them, without what a "
                       "filter softens on purpose; default: 1.25 times that of the least wrong "
                       "setting tried, plus 0.02 points, and at most 50 %");
    command.add_option("--max-false-lit", options.max_false_lit,
                       "Largest amount of light on blocked pixels, the same");
    command
        .add_option("--max-false-shadow-count", options.max_false_shadow_count,
                    "Largest share of the lit pixels whose verdict may be below one half")
        ->capture_default_str();
    command
        .add_option("--max-false-lit-count", options.max_false_lit_count,
                    "Largest share of the blocked pixels whose verdict may be one half or more")
        ->capture_default_str();
    command.add_option("--max-resolution", options.max_resolution, "Largest map [texels]")
        ->check(CLI::Range(1, 16384))
        ->capture_default_str();
}

} // namespace

void add_tune_command(CLI::App& program)
{
    auto options = std::make_shared<TuneOptions>();
    CLI::App* command =
        program.add_subcommand("tune", "Recommend the cheapest shadow map that is as good as the "
                                       "scene allows, or meets your limits");
    add_job_options(*command, options->job);
    add_renderer_options(*command, options->renderer);
    command
        ->add_option("--budget", options->budget,
                     "Of another renderer: how many settings of its own keys are drawn at most")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    add_limit_options(*command, *options);
    command
        ->add_option("--time", options->time_s,
                     "Seconds after which it answers with what it has found")
        ->check(CLI::Range(1.0, 86400.0))
        ->capture_default_str();
    add_advice_options(*command, options->advice);
    add_methods_option(*command, options->methods);
    command->add_flag("--json", options->json, "Print the result as JSON (docs/tune.md)");
    add_engine_option(*command, options->engine,
                      "Also print what was found in the settings of an engine");
    command->add_flag("--verbose", options->verbose,
                      "Print every setting that was tried, states for GL, Direct3D and Vulkan, and "
                      "why the rest is wrong");
    command->add_flag("--quiet", options->quiet,
                      "Print nothing but the recommended keys, and no progress");
    add_session_options(*command, options->session);
    command->footer("Exit status: 0 a setting meets the limits; 1 none does.\n\nExamples:\n"
                    "  gnomon tune --builtin columns\n"
                    "  gnomon tune job.toml --time 300\n"
                    "  gnomon tune job.toml --engine godot\n"
                    "  gnomon tune job.toml --views 8\n"
                    "  gnomon tune job.toml --methods all\n"
                    "  gnomon tune job.toml --max-false-shadow 0.05% --max-false-lit 1% "
                    "--max-resolution 2048");
    command->callback([options, command] {
        for (const char* const limit :
             {"--max-false-shadow", "--max-false-lit", "--max-false-shadow-count",
              "--max-false-lit-count", "--max-resolution"}) {
            options->has_limits = options->has_limits || command->count(limit) > 0;
        }
        options->has_time = command->count("--time") > 0;
        tune(*options);
    });
}

} // namespace gnomon::cli
