#include "cli/commands.hpp"

#include "api/compare.hpp"
#include "api/sweep/sweep.hpp"
#include "cli/exit_codes.hpp"
#include "cli/options/job_options.hpp"
#include "cli/runs/watched_sweep.hpp"
#include "cli/system/process.hpp"
#include "cli/units/planned_sweep.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/run/run_schema.hpp"
#include "store/run_folder/run_lock.hpp"
#include "store/units/unit_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

/// The options of `gnomon run-unit`.
struct UnitRunOptions {
    std::filesystem::path plan;
    std::string unit;             ///< id or number
    std::filesystem::path folder; ///< for the unit's file
    std::filesystem::path scenes; ///< a folder of packed scenes; may be empty
    bool retries_failed = false;
    bool is_quiet = false;
    api::SessionOptions session;
};

/// The result of `run_unit`.
struct UnitOutcome {
    std::filesystem::path file; ///< the unit's results; missing if interrupted
    std::uint32_t number = 0;
    std::uint32_t count = 0; ///< of the plan's units
    bool was_known = false;  ///< the file existed already
    api::SweepOutcome sweep;
};

namespace fs = std::filesystem;
using store::PlannedScene;
using store::PlannedUnit;
using store::UnitPlan;

void require_version(const UnitPlan& plan, const fs::path& path)
{
    if (plan.gnomon != GNOMON_VERSION) {
        throw scene::InputError(scene::one_line(
            fmt::format("{}: was made by gnomon {}, this is {}: use that version, or plan again"
                        "",
                        path.string(), plan.gnomon, GNOMON_VERSION)));
    }
}

/// Enters the plan's directory, where its relative paths begin.
void enter_directory(const UnitPlan& plan, const PlannedUnit& unit, const UnitRunOptions& options)
{
    std::error_code error;
    fs::current_path(plan.directory, error);
    if (error && !has_packed_scenes(options.scenes, plan, unit)) {
        throw scene::InputError(scene::one_line(fmt::format(
            "{}: its scenes are in {}, which does not exist here ({}): share that folder, "
            "pass packed scenes with --scenes, or plan again",
            options.plan.string(), plan.directory.string(), error.message())));
    }
}

std::string content_text(const PlannedScene& scene)
{
    return scene.hash.empty() ? "could not be read"
                              : fmt::format("has the content {}-{}", scene.hash, scene.brought);
}

/// @throws scene::InputError  if the scene is not what it was when the plan was made.
void require_planned_scene(const UnitPlan& plan, const std::string& keys,
                           const api::SceneContent& content)
{
    const auto planned = std::ranges::find(plan.scenes, keys, &PlannedScene::keys);
    if (planned == plan.scenes.end()) {
        throw scene::InputError(scene::one_line(
            fmt::format("plan {}: does not name the scene {}: plan again", plan.id, keys)));
    }
    const PlannedScene here = planned_scene(planned->name, keys, content);
    const bool is_same =
        here.hash == planned->hash && (here.hash.empty() || here.brought == planned->brought);
    if (!is_same) {
        throw scene::InputError(scene::one_line(
            fmt::format("{}: it {} here, and {} in plan {}: restore the scene of the plan, or "
                        "plan again",
                        planned->name, content_text(here), content_text(*planned), plan.id)));
    }
}

api::SweepOutcome outcome_of(const store::UnitSummary& unit)
{
    api::SweepOutcome outcome;
    outcome.configurations = unit.outcome.done + unit.outcome.failed + unit.outcome.planned;
    outcome.done = unit.outcome.done;
    outcome.failed = unit.outcome.failed;
    outcome.retriable = unit.retriable;
    outcome.checks = unit.checks;
    return outcome;
}

/// The outcome in the unit's file; empty if that is missing or damaged.
/// @throws scene::InputError  if it is of another plan.
std::optional<api::SweepOutcome> known_outcome(const fs::path& file, const store::UnitMark& mark)
{
    if (!fs::exists(file)) {
        return std::nullopt;
    }
    try {
        const store::UnitSummary there = store::read_unit_file(file);
        if (there.mark != mark) {
            throw scene::InputError(scene::one_line(
                fmt::format("{}: is of plan {}, this is plan {}: name another folder",
                            file.string(), there.mark.plan, mark.plan)));
        }
        return outcome_of(there);
    } catch (const store::sqlite::DamagedDatabase&) {
        return std::nullopt; // a new file will replace it
    }
}

/// A folder for a unit's work, locked by this process.
struct WorkFolder {
    fs::path path;
    std::unique_ptr<store::RunLock> lock;
};

/// Locks the first free folder; results that an ended process left there are used.
WorkFolder work_folder(const fs::path& folder, const std::string& unit)
{
    constexpr int most_processes = 100;
    for (int i = 1; i <= most_processes; ++i) {
        fs::path work = folder / fmt::format(".{}.{}", unit, i);
        try {
            auto lock = std::make_unique<store::RunLock>(work);
            return {std::move(work), std::move(lock)};
        } catch (const scene::InputError&) {
            continue; // another process computes the unit there
        } catch (const scene::EnvironmentError&) {
            if (fs::exists(work)) {
                throw;
            }
            // Another process has just finished and removed it.
        }
    }
    throw scene::InputError(scene::one_line(
        fmt::format("{}: {} processes compute unit {} there: wait for them, or name another folder",
                    folder.string(), most_processes, unit)));
}

/// Removes work folders that ended processes left behind.
void remove_leftovers(const fs::path& folder, const std::string& unit)
{
    const std::string beginning = fmt::format(".{}.", unit);
    std::vector<fs::path> left;
    std::error_code error;
    for (fs::directory_iterator entry{folder, error}; !error && entry != fs::directory_iterator{};
         entry.increment(error)) {
        if (entry->path().filename().string().starts_with(beginning)) {
            left.push_back(entry->path());
        }
    }
    for (const fs::path& work : left) {
        try {
            const store::RunLock lock{work};
            fs::remove_all(work, error); // leftovers do no harm
        } catch (const scene::InputError&) {
            continue; // another process computes the unit there
        } catch (const scene::EnvironmentError&) {
            continue; // its process has just removed it
        }
    }
}

api::SweepRunOptions run_options_of(const UnitPlan& plan, const PlannedUnit& unit,
                                    const UnitRunOptions& options, fs::path work)
{
    api::SweepRunOptions run;
    run.folder = std::move(work);
    run.shard = {unit.number, static_cast<std::uint32_t>(plan.units.size())};
    run.unit = api::SweepUnit{
        analysis::ordinals_of(unit.ordinals),
        plan.keeps_normals ? scene::VertexNormals::kept : scene::VertexNormals::dropped,
        [&plan](const std::string& keys, const api::SceneContent& content) {
            require_planned_scene(plan, keys, content);
        },
        [&plan, &options](const scene::Job& job, scene::VertexNormals normals) {
            return load_planned_scene(options.scenes, plan, job, normals);
        }};
    std::ranges::sort(run.unit->ordinals);
    run.retries_failed = options.retries_failed;
    run.job_text = plan.job.text.empty() ? job_text(options_of(plan.job)) : plan.job.text;
    run.command = plan.command;
    run.compare_command = plan.compare_command;
    run.session = options.session;
    return run;
}

/// Computes a unit of a plan, unless its file exists. If it is interrupted or killed, a hidden
/// folder beside the file keeps the finished part. Several processes may compute the same unit.
/// @throws scene::InputError        if there is no such unit, the plan is of another version or its
///                                  scenes have changed, or the file is of another plan.
/// @throws scene::EnvironmentError  as `api::sweep`.
UnitOutcome run_unit(UnitRunOptions options)
{
    options.plan = fs::absolute(options.plan);
    options.folder = fs::absolute(options.folder);
    options.scenes = options.scenes.empty() ? fs::path{} : fs::absolute(options.scenes);
    const UnitPlan plan = store::read_unit_plan(options.plan);
    require_version(plan, options.plan);
    const PlannedUnit& unit = store::find_unit(plan, options.unit, options.plan);
    const store::UnitMark mark{plan.id, unit.id};
    UnitOutcome outcome{store::unit_path(options.folder, unit.id),
                        unit.number,
                        static_cast<std::uint32_t>(plan.units.size()),
                        false,
                        {}};
    const auto known = known_outcome(outcome.file, mark);
    if (known && !(options.retries_failed && known->retriable > 0)) {
        outcome.sweep = *known;
        outcome.was_known = true;
        remove_leftovers(options.folder, unit.id);
        return outcome;
    }
    const auto [work, lock] = work_folder(options.folder, unit.id);
    if (known) {
        fs::copy_file(outcome.file, store::results_path(work),
                      fs::copy_options::overwrite_existing);
    }
    enter_directory(plan, unit, options);
    const scene::SweepSpace space = space_of(plan.job);
    outcome.sweep =
        watched_sweep(space, run_options_of(plan, unit, options, work), options.is_quiet);
    if (!outcome.sweep.is_interrupted) {
        store::publish_unit(work, mark, outcome.file);
        fs::remove_all(work);
    }
    return outcome;
}

struct RunUnitOptions {
    UnitRunOptions unit;
    std::string retry;
};

void run_unit_command(const RunUnitOptions& options)
{
    UnitRunOptions run = options.unit;
    run.retries_failed = !options.retry.empty();
    const UnitOutcome outcome = run_unit(std::move(run));
    const api::SweepOutcome& sweep = outcome.sweep;
    if (sweep.is_interrupted) {
        fmt::print(stderr, "gnomon: interrupted; the same command goes on where this stopped\n");
        throw CLI::RuntimeError{exit_codes::interrupted};
    }
    print(fmt::format("unit {} of {}, {} of {} done{}: {}\n", outcome.number, outcome.count,
                      reports::grouped(sweep.done),
                      reports::counted(sweep.configurations, "configuration"),
                      outcome.was_known ? " before" : "", outcome.file.string()));
    if (sweep.failed > 0) {
        fmt::print(stderr, "gnomon: {} failed{}\n", reports::counted(sweep.failed, "configuration"),
                   sweep.retriable > 0 ? "; --retry failed tries again" : "");
        throw CLI::RuntimeError{exit_codes::incomplete};
    }
    if (!sweep.checks.are_passed()) {
        fmt::print(stderr, "gnomon: {}\n", store::failed_checks_text(sweep.checks));
        throw CLI::RuntimeError{exit_codes::environment_failed};
    }
}

} // namespace

void add_run_unit_command(CLI::App& program)
{
    auto options = std::make_shared<RunUnitOptions>();
    CLI::App* command = program.add_subcommand(
        "run-unit", "Compute one unit of a planned sweep; resumes where it was stopped");
    command->add_option("PLAN", options->unit.plan, "The file that `gnomon plan` wrote")
        ->required();
    command->add_option("UNIT", options->unit.unit, "Its id, or its number from 1 on")->required();
    command
        ->add_option("--out", options->unit.folder,
                     "The folder for the file of its results, ID.unit")
        ->required();
    command->add_option("--scenes", options->unit.scenes,
                        "A folder of scenes that `gnomon plan --scenes` packed; what it lacks is "
                        "read where the job says");
    command->add_option("--retry", options->retry, "failed: compute failed configurations again")
        ->check(CLI::IsMember({"failed"}));
    command->add_flag("--quiet", options->unit.is_quiet, "No progress on stderr");
    add_session_options(*command, options->unit.session);
    command->footer(
        "Exit status: 0 the file is there and all are done; 2 there is no such unit, or the plan "
        "is of other scenes or another version; 4 GL, Embree or the disk failed, or GL and the "
        "truth disagree where they must not; 5 the file is there, but some failed; 130 "
        "interrupted.\n\nExamples:\n"
        "  gnomon run-unit plan.jsonl 7 --out units\n"
        "  parallel gnomon run-unit plan.jsonl {} --out units ::: $(seq 200)");
    command->callback([options] { run_unit_command(*options); });
}

} // namespace gnomon::cli
