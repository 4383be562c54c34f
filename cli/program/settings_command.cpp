#include "cli/commands.hpp"

#include "analysis/presets/engine_settings.hpp"
#include "api/compare.hpp"
#include "cli/options/advice_options.hpp"
#include "cli/options/job_options.hpp"
#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"
#include "methods/key_table.hpp"
#include "reports/text/engine_settings_text.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/presets/presets.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

struct SettingsOptions {
    JobOptions job;
    api::SessionOptions session;
    std::string engine;
    bool own = false;
    bool json = false;
};

void settings(const SettingsOptions& options)
{
    const scene::Preset preset =
        scene::find_engine(*methods::key_table(), options.engine, "--engine " + options.engine);
    const scene::JobSource source = read_job_source(options.job);
    const auto jobs = scene::light_jobs(source, options.job.case_name);
    note_ignored_cases("settings", options.job, source);
    SlowWork work{"comparing"};
    const api::ComparisonSession session{jobs, options.session};
    const auto compared = api::compare(session, jobs);
    std::vector<analysis::EngineSettings> lights;
    std::vector<std::string> left_out;
    for (const analysis::Comparison& comparison : compared) {
        try {
            lights.push_back(analysis::engine_settings(preset, comparison, !options.own));
        } catch (const scene::InputError& error) { // another light may have settings
            if (lights.empty() && &comparison == &compared.back()) {
                throw;
            }
            left_out.push_back(fmt::format("light {}: {}", comparison.light, error.what()));
        }
    }
    print(options.json ? reports::engine_settings_json(lights)
                       : reports::engine_settings_text(lights));
    for (const std::string& line : left_out) {
        fmt::print(stderr, "gnomon settings: note: {}\n", line);
    }
}

} // namespace

void add_settings_command(CLI::App& program)
{
    auto options = std::make_shared<SettingsOptions>();
    CLI::App* command = program.add_subcommand(
        "settings", "Print what to type in an engine to get a job's shadow map");
    add_job_options(*command, options->job);
    command
        ->add_option("--engine", options->engine,
                     fmt::format("The engine: {}", fmt::join(scene::engine_names(), ", ")))
        ->required();
    command->add_flag("--own", options->own,
                      "Translate the job's own bias, not the recommended one");
    command->add_flag("--json", options->json, "Print them as JSON (docs/json_schema.md)");
    add_session_options(*command, options->session);
    command->footer("Examples:\n"
                    "  gnomon settings model.glb --engine three\n"
                    "  gnomon settings job.toml --engine unity --own\n"
                    "  gnomon settings --builtin yard --engine godot");
    command->callback([options] { settings(*options); });
}

} // namespace gnomon::cli
