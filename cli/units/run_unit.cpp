#include "cli/units/run_unit.hpp"

#include "cli/options/command_text.hpp"
#include "cli/runs/watched_sweep.hpp"
#include "cli/units/packed_scenes.hpp"
#include "cli/units/planned_sweep.hpp"
#include "scene/error.hpp"
#include "scene/one_line.hpp"
#include "store/run/run_schema.hpp"
#include "store/run_folder/run_lock.hpp"
#include "store/units/unit_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;
using store::PlannedScene;
using store::PlannedUnit;
using store::UnitPlan;

void require_version(const UnitPlan& plan, const fs::path& path)
{
    if (plan.gnomon != GNOMON_VERSION) {
        throw scene::InputError(scene::one_line(
            fmt::format("{}: was made by gnomon {}, this is {}: compute it with that version, or "
                        "plan anew",
                        path.string(), plan.gnomon, GNOMON_VERSION)));
    }
}

/// Relative paths of a plan begin where it was made.
void enter_directory(const UnitPlan& plan, const PlannedUnit& unit, const UnitRunOptions& options)
{
    std::error_code error;
    fs::current_path(plan.directory, error);
    if (error && !has_packed_scenes(options.scenes, plan, unit)) {
        throw scene::InputError(scene::one_line(fmt::format(
            "{}: its scenes lie in {}, which is not here ({}): share that folder, bring "
            "them packed with --scenes, or plan anew",
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
            fmt::format("plan {}: does not name the scene {}: plan anew", plan.id, keys)));
    }
    const PlannedScene here = planned_scene(planned->name, keys, content);
    const bool is_same =
        here.hash == planned->hash && (here.hash.empty() || here.brought == planned->brought);
    if (!is_same) {
        throw scene::InputError(scene::one_line(
            fmt::format("{}: it {} here, and {} in plan {}: bring back the scene of the plan, or "
                        "plan anew",
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

/// What is known of the unit; empty unless its file is there and whole.
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
        return std::nullopt; // computed again, it replaces what is there
    }
}

/// A folder for a unit's work, which no other process has.
struct WorkFolder {
    fs::path path;
    std::unique_ptr<store::RunLock> lock;
};

/// The first that is free; what a process that ended has left there is gone on with.
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
            // One that was done with it has just removed it.
        }
    }
    throw scene::InputError(scene::one_line(
        fmt::format("{}: {} processes compute unit {} there: wait for them, or name another folder",
                    folder.string(), most_processes, unit)));
}

/// Removes what processes left that ended when the unit's file was there, and their folder, too.
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
            fs::remove_all(work, error); // what cannot be removed does no harm
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

} // namespace

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

} // namespace gnomon::cli
