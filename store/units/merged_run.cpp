#include "store/units/merged_run.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/csv/run_csv.hpp"
#include "store/merge/merge.hpp"
#include "store/run/run_plan.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>

namespace gnomon::store {

namespace {

using analysis::Environment;

bool is_known(const Environment& environment)
{
    return !environment.gl_renderer.empty();
}

} // namespace

MergedRun::MergedRun(const std::filesystem::path& folder, const RunDescription& description,
                     Environments environments, Failures failures)
    : folder_{folder},
      database_{results_path(folder), sqlite::Database::Access::write},
      description_{description},
      environments_{environments}
{
    prepare_run(database_);
    const RunDescription earlier = read_description(database_);
    if (earlier.size != 0) {
        require_same_sweep(earlier);
        description_.environment = earlier.environment;
        description_.notes = earlier.notes;
    }
    description_.shard = {};
    sqlite::Transaction transaction{database_};
    write_description(database_, description_);
    transaction.commit();
    read_known(failures);
}

void MergedRun::require_same_sweep(const RunDescription& description) const
{
    if (description.size != description_.size || description.axes != description_.axes ||
        description.lights != description_.lights || description.shard.count != 1) {
        throw scene::InputError(scene::one_line(fmt::format(
            "{}: holds another sweep, or a part of one: name another folder", folder_.string())));
    }
}

void MergedRun::read_known(Failures failures)
{
    is_known_.assign(description_.size, false);
    const char* const counts =
        failures == Failures::kept
            ? "c.status <> 'planned'"
            : "c.status = 'done' OR (c.status = 'failed' AND NOT c.may_pass)";
    sqlite::Statement find{database_,
                           fmt::format("SELECT p.ordinal FROM plan p CROSS JOIN configurations c"
                                       " ON c.number = p.configuration WHERE {}",
                                       counts)};
    while (find.step()) {
        const auto ordinal = static_cast<std::uint64_t>(find.integer(0));
        if (ordinal < is_known_.size()) {
            is_known_[ordinal] = true;
        }
    }
}

bool MergedRun::has(const PlannedUnit& unit) const
{
    const std::vector<std::uint64_t> ordinals = analysis::ordinals_of(unit.ordinals);
    return std::ranges::all_of(ordinals, [&](std::uint64_t ordinal) { return is_known_[ordinal]; });
}

void MergedRun::require_environment(const UnitSummary& unit,
                                    const std::filesystem::path& file) const
{
    const Environment& there = unit.description.environment;
    if (environments_ == Environments::one && is_known(description_.environment) &&
        environment_text(there) != environment_text(description_.environment)) {
        throw scene::InputError(scene::one_line(fmt::format(
            "{}: was computed in another environment ({}) than the run ({}): use workers of one "
            "kind, or pass --allow-mixed",
            file.string(), environment_text(there), environment_text(description_.environment))));
    }
}

UnitSummary MergedRun::take(const std::filesystem::path& file, const std::string& plan)
{
    UnitSummary unit = read_unit_file(file);
    if (unit.mark.plan != plan) {
        throw scene::InputError(scene::one_line(
            fmt::format("{}: belongs to plan {}, the sweep to plan {}: remove the file",
                        file.string(), unit.mark.plan, plan)));
    }
    require_environment(unit, file);
    if (!is_known(description_.environment)) {
        description_.environment = unit.description.environment;
    }
    for (const RunNote& of_unit : unit.description.notes) {
        add_notes(description_.notes, of_unit.scene, std::span{&of_unit.note, 1},
                  of_unit.configurations);
    }
    merge_into(database_, file, file, [&] { write_description(database_, description_); });
    return unit;
}

PlanOutcome MergedRun::outcome() const
{
    PlanOutcome outcome = read_outcome(database_);
    outcome.planned = description_.size - outcome.done - outcome.failed;
    return outcome;
}

std::uint64_t MergedRun::retriable() const
{
    return read_retriable(database_);
}

RunChecks MergedRun::checks() const
{
    return read_run_checks(database_);
}

void MergedRun::write_csv() const
{
    write_run_csv(database_, folder_);
}

} // namespace gnomon::store
