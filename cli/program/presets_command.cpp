#include "cli/commands.hpp"

#include "analysis/comparison/comparison.hpp"
#include "analysis/presets/preset_result.hpp"
#include "analysis/sweep/compare.hpp"
#include "api/compare.hpp"
#include "api/memory.hpp"
#include "cli/options/job_options.hpp"
#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"
#include "methods/job_method.hpp"
#include "methods/key_table.hpp"
#include "reports/catalogue/catalogue.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/presets/presets.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <string>

namespace gnomon::cli {
namespace {

struct PresetsOptions {
    JobOptions job;
    api::SessionOptions session;
    bool json = false;
    bool compares = false;
};

std::string preset_label(const scene::Preset* preset)
{
    return preset == nullptr ? "the job" : preset->name;
}

/// @throws scene::EnvironmentError  if GL's triangle at a pixel cannot be explained.
void require_no_preset_mismatch(const analysis::PresetResult& result)
{
    const auto mismatches = result.metrics.pixels.of(scene::ClassReason::mismatch);
    if (mismatches > 0) {
        throw scene::EnvironmentError(
            fmt::format("{}: {} pixels mismatch; report it with the job and the output of `gnomon "
                        "doctor`",
                        preset_label(result.preset), mismatches));
    }
}

void list_presets(const PresetsOptions& options)
{
    const JobOptions& job = options.job;
    const bool has_job = !job.job_path.empty() || !job.builtin.empty() || !job.preset.empty() ||
                         !job.settings.empty() || !job.case_name.empty() || job.light;
    if (has_job) {
        throw scene::InputError("a job needs --compare: add it, or remove the job");
    }
    const auto all = scene::presets(*methods::key_table());
    print(options.json ? reports::presets_json(all) : reports::presets_table(all));
}

/// Compares a job with each preset laid over it.
class PresetTrial {
public:
    explicit PresetTrial(const PresetsOptions& options)
        : source_{read_job_source(options.job)},
          case_name_{options.job.case_name},
          presets_{scene::presets(*source_.keys)}
    {
        if (!source_.lights.empty()) {
            throw scene::InputError(
                fmt::format("--compare: presets are for one light: choose one with --light, {}",
                            fmt::join(source_.lights, " or ")));
        }
    }

    /// @return  The results point to this object's presets.
    [[nodiscard]] analysis::PresetComparison run(const PresetsOptions& options) &
    {
        SlowWork work{"reading the scene"};
        const scene::Job job = scene::job_of(source_, case_name_).job;
        if (!methods::traits(job).has_map) {
            throw scene::InputError(
                fmt::format("--compare: method.name = \"{}\" has no shadow map for presets to "
                            "change: remove the method",
                            job.method.name));
        }
        const api::ComparisonSession session{job, options.session};
        analysis::PresetComparison comparison;
        comparison.light = scene::resolve_light(job, session.file().defaults).type;
        comparison.job = compare(job, nullptr, session, work);
        comparison.scene = analysis::scene_name(job.scene);
        for (const scene::Preset& preset : presets_) {
            if (preset.is_for(comparison.light)) {
                try_preset(preset, session, work, comparison);
            } else {
                comparison.skipped.push_back(
                    {&preset,
                     fmt::format("not for a {} light", scene::light_type_name(comparison.light))});
            }
        }
        return comparison;
    }

private:
    void try_preset(const scene::Preset& preset, const api::ComparisonSession& session,
                    SlowWork& work, analysis::PresetComparison& comparison) const
    {
        const scene::CaseLayer* chosen =
            case_name_.empty() ? nullptr : &scene::find_case(source_, case_name_);
        try {
            const scene::Job job = scene::make_job(scene::with_preset(source_, chosen, preset));
            comparison.results.push_back(compare(job, &preset, session, work));
        } catch (const scene::InputError& error) { // e.g. a --set that conflicts with the preset
            comparison.skipped.push_back({&preset, error.what()});
        }
    }

    static analysis::PresetResult compare(const scene::Job& job, const scene::Preset* preset,
                                          const api::ComparisonSession& session, SlowWork& work)
    {
        work.now(fmt::format("comparing {}", preset_label(preset)));
        api::require_memory(job);
        const analysis::Comparison comparison =
            analysis::compare(job, session.file(), session.renderers());
        return analysis::preset_result(comparison, preset);
    }

    scene::JobSource source_;
    std::string case_name_;
    std::vector<scene::Preset> presets_; ///< results point to them
};

void presets(const PresetsOptions& options)
{
    if (!options.compares) {
        return list_presets(options);
    }
    PresetTrial trial{options};
    const analysis::PresetComparison comparison = trial.run(options);
    print(options.json ? reports::preset_comparison_json(comparison)
                       : reports::preset_comparison_table(comparison));
    require_no_preset_mismatch(comparison.job);
    std::ranges::for_each(comparison.results, require_no_preset_mismatch);
}

} // namespace

void add_presets_command(CLI::App& program)
{
    auto options = std::make_shared<PresetsOptions>();
    CLI::App* command = program.add_subcommand(
        "presets", "List the shadow maps of lessons and engines, or compare them on a job");
    command->add_flag("--compare", options->compares,
                      "Compare a job with each preset that is for its light, and show their biases "
                      "and errors side by side (docs/presets.md)");
    add_job_options(*command, options->job);
    command->add_flag("--json", options->json, "Print them as JSON (docs/json_schema.md)");
    add_session_options(*command, options->session);
    command->footer("Examples:\n"
                    "  gnomon presets\n"
                    "  gnomon compare --preset lesson-webgl\n"
                    "  gnomon compare job.toml --preset bevy\n"
                    "  gnomon presets --compare --builtin yard");
    command->callback([options] { presets(*options); });
}

} // namespace gnomon::cli
