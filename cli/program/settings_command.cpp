#include "cli/commands.hpp"

#include "api/compare.hpp"
#include "cli/options/advice_options.hpp"
#include "cli/options/engine_option.hpp"
#include "cli/options/job_options.hpp"
#include "cli/runs/run_jobs.hpp"
#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"
#include "reports/settings/settings_text.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"
#include "scene/text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

struct SettingsOptions {
    JobOptions job;
    std::string configuration;
    api::SessionOptions session;
    std::string engine;
    bool own = false;
    bool json = false;
};

/// The jobs that are translated, one for each light or configuration.
std::vector<RunJob> jobs_of(const SettingsOptions& options)
{
    const JobOptions& job = options.job;
    if (!std::filesystem::is_directory(job.job_path)) {
        if (!options.configuration.empty()) {
            throw scene::InputError("--configuration needs the folder of a run");
        }
        const scene::JobSource source = read_job_source(job);
        note_ignored_cases("settings", job, source);
        std::vector<RunJob> jobs;
        for (scene::LightJob& light : scene::light_jobs(source, job.case_name)) {
            jobs.push_back({{}, {}, {}, std::move(light)});
        }
        return jobs;
    }
    if (!job.builtin.empty() || !job.preset.empty() || !job.settings.empty() ||
        !job.case_name.empty() || job.light) {
        throw scene::InputError(
            fmt::format("{}: a run has its own jobs; choose one with --configuration alone",
                        scene::one_line(job.job_path)));
    }
    return jobs_of_run(job.job_path, options.configuration);
}

/// The lights of one job share a scene; configurations may have different ones.
std::vector<std::span<const RunJob>> by_scene(const std::vector<RunJob>& jobs)
{
    if (jobs.front().configuration.empty()) {
        return {jobs};
    }
    std::vector<std::span<const RunJob>> each;
    for (const RunJob& job : jobs) {
        each.emplace_back(&job, 1);
    }
    return each;
}

/// "configuration 3f2a" or "light sun"; empty for the only one.
std::string label_of(const RunJob& job)
{
    if (!job.configuration.empty()) {
        return fmt::format("configuration {}", job.configuration);
    }
    return job.job.light.empty() ? std::string{} : fmt::format("light {}", job.job.light);
}

/// Compares jobs that share a scene, and translates them.
void add(Translations& translations, std::span<const RunJob> jobs,
         const api::SessionOptions& options)
{
    std::vector<scene::LightJob> lights;
    for (const RunJob& job : jobs) {
        lights.push_back(job.job);
    }
    const api::ComparisonSession session{lights, options};
    const auto compared = api::compare(session, lights);
    for (std::size_t i = 0; i < compared.size(); ++i) {
        auto* const added = translations.add(compared[i], compared[i].light, label_of(jobs[i]));
        if (added != nullptr) {
            added->configuration = jobs[i].configuration;
            added->case_name = jobs[i].case_name;
            added->changed = jobs[i].settings;
        }
    }
}

void settings(const SettingsOptions& options)
{
    Translations translations{engine_target(options.engine),
                              options.own ? EngineBias::own : EngineBias::recommended};
    const std::vector<RunJob> jobs = jobs_of(options);
    {
        const SlowWork work{"comparing"};
        for (const std::span<const RunJob> one : by_scene(jobs)) {
            add(translations, one, options.session);
        }
    }
    if (translations.all().empty()) {
        throw scene::InputError(translations.last_reason());
    }
    print(options.json ? reports::settings_json(translations.all())
                       : reports::settings_text(translations.all()));
    translations.print_notes("settings");
}

} // namespace

void add_settings_command(CLI::App& program)
{
    auto options = std::make_shared<SettingsOptions>();
    CLI::App* command = program.add_subcommand(
        "settings", "Print what to type in an engine to get a job's shadow map");
    add_job_options(*command, options->job);
    command->get_option("JOB")->description(
        "A job file (.toml), a scene file (.gltf .glb .obj .ply) for a job of defaults, or RUN, "
        "the folder of `gnomon sweep --out` or `compare --out`, for its best configuration");
    command->add_option("--configuration", options->configuration,
                        "ID of another configuration of RUN");
    add_engine_option(*command, options->engine, "The engine, or a shader language or graphics API")
        ->required();
    command->add_flag("--own", options->own,
                      "Translate the job's own bias, not the recommended one");
    command->add_flag("--json", options->json, "Print them as JSON (docs/json_schema.md)");
    add_session_options(*command, options->session);
    command->footer("Examples:\n"
                    "  gnomon settings model.glb --engine three\n"
                    "  gnomon settings job.toml --engine unity --own\n"
                    "  gnomon settings --builtin yard --engine godot\n"
                    "  gnomon settings run --engine ue5\n"
                    "  gnomon settings --builtin yard --engine glsl");
    command->callback([options] { settings(*options); });
}

} // namespace gnomon::cli
