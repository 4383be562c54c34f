#include "cli/commands.hpp"

#include "api/compare.hpp"
#include "cli/options/advice_options.hpp"
#include "cli/options/job_options.hpp"
#include "cli/runs/run_jobs.hpp"
#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"
#include "methods/key_table.hpp"
#include "reports/settings/settings_text.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"
#include "scene/text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
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

/// Compares each job and translates it.
class SettingsTranslation {
public:
    explicit SettingsTranslation(const SettingsOptions& options)
        : options_{options},
          target_{reports::find_settings_target(*methods::key_table(), options.engine,
                                                "--engine " + options.engine)}
    {
    }

    /// @return  The results point to this object's engine.
    [[nodiscard]] std::vector<reports::TranslatedSettings> run() &
    {
        const std::vector<RunJob> jobs = jobs_of(options_);
        SlowWork work{"comparing"};
        for (const std::span<const RunJob> one : by_scene(jobs)) {
            add(one);
        }
        if (translated_.empty()) {
            throw *refusal_;
        }
        return std::move(translated_);
    }
    /// Why other lights or configurations were left out.
    [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

private:
    /// The lights of one job share a scene; configurations may have different ones.
    [[nodiscard]] static std::vector<std::span<const RunJob>>
    by_scene(const std::vector<RunJob>& jobs)
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

    void add(std::span<const RunJob> jobs)
    {
        std::vector<scene::LightJob> lights;
        for (const RunJob& job : jobs) {
            lights.push_back(job.job);
        }
        const api::ComparisonSession session{lights, options_.session};
        const auto compared = api::compare(session, lights);
        for (std::size_t i = 0; i < compared.size(); ++i) {
            add(jobs[i], compared[i]);
        }
    }

    void add(const RunJob& job, const analysis::Comparison& comparison)
    {
        try {
            reports::TranslatedSettings one =
                reports::translate(target_, comparison, !options_.own);
            one.configuration = job.configuration;
            one.case_name = job.case_name;
            one.changed = job.settings;
            translated_.push_back(std::move(one));
        } catch (const scene::InputError& error) { // another light may have settings
            refusal_ = error;
            left_out_.push_back(
                job.configuration.empty()
                    ? fmt::format("light {}: {}", comparison.light, error.what())
                    : fmt::format("configuration {}: {}", job.configuration, error.what()));
        }
    }

    const SettingsOptions& options_;
    reports::SettingsTarget target_;
    std::vector<reports::TranslatedSettings> translated_;
    std::vector<std::string> left_out_;
    std::optional<scene::InputError> refusal_;
};

void settings(const SettingsOptions& options)
{
    SettingsTranslation translation{options};
    const std::vector<reports::TranslatedSettings> translated = translation.run();
    print(options.json ? reports::settings_json(translated) : reports::settings_text(translated));
    for (const std::string& line : translation.left_out()) {
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
    command->get_option("JOB")->description(
        "A job file (.toml), a scene file (.gltf .glb .obj .ply) for a job of defaults, or RUN, "
        "the "
        "folder of `gnomon sweep --out` or `compare --out`, for its best configuration");
    command->add_option("--configuration", options->configuration,
                        "ID of another configuration of RUN");
    command
        ->add_option("--engine", options->engine,
                     fmt::format("The engine, or a shader language or graphics API: {}",
                                 fmt::join(reports::settings_target_names(), ", ")))
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
