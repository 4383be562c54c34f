#include "store/merge/merge.hpp"

#include "scene/error.hpp"
#include "store/csv/run_csv.hpp"
#include "store/run/run_plan.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_schema.hpp"
#include "store/units/unit_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::store {

namespace {

using analysis::Environment;
using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

bool are_equal(const Environment& a, const Environment& b)
{
    return a.gl_renderer == b.gl_renderer && a.gl_version == b.gl_version && a.embree == b.embree &&
           a.gnomon == b.gnomon;
}

/// An input of the merge: a run, or a unit of a planned sweep.
struct Input {
    std::filesystem::path path; ///< as given, or a file in a given folder
    bool is_unit = false;

    [[nodiscard]] std::filesystem::path database() const
    {
        return is_unit ? path : results_path(path);
    }
};

/// Expands folders of unit files.
std::vector<Input> inputs_of(std::span<const std::filesystem::path> paths)
{
    std::vector<Input> inputs;
    for (const std::filesystem::path& path : paths) {
        std::error_code error;
        if (std::filesystem::is_regular_file(path, error)) {
            inputs.push_back({path, true});
            continue;
        }
        const bool is_run = std::filesystem::exists(results_path(path), error);
        const std::vector<std::filesystem::path> units =
            is_run ? std::vector<std::filesystem::path>{} : unit_files(path);
        for (const std::filesystem::path& unit : units) {
            inputs.push_back({unit, true});
        }
        if (units.empty()) {
            inputs.push_back({path, false}); // a run, or a path that will be refused
        }
    }
    return inputs;
}

std::string plan_text_of(const UnitSummary& unit)
{
    return fmt::format("plan {} (gnomon {}, scenes {})", unit.mark.plan,
                       unit.description.environment.gnomon, fmt::join(unit.scenes, " "));
}

/// Checks before the merge that all inputs belong together.
class InputCheck {
public:
    explicit InputCheck(Environments environments) : environments_{environments} {}

    /// Whether the input can be merged. A damaged unit file cannot; it is remembered.
    bool admit(const Input& input)
    {
        if (!input.is_unit) {
            require_same(input, RunStore{input.path, RunStore::Access::read}.description());
            return true;
        }
        try {
            admit_unit(input, read_unit_file(input.path));
            return true;
        } catch (const sqlite::DamagedDatabase& error) {
            damaged_.emplace_back(error.what());
            return false;
        }
    }

    /// The description of the whole sweep, with the notes of all units.
    [[nodiscard]] const RunDescription& description() const { return *first_; }
    [[nodiscard]] const std::vector<std::string>& damaged() const { return damaged_; }
    [[nodiscard]] std::uint64_t repeated() const { return repeated_; }
    /// The numbers of the plan's units without a file, ascending.
    [[nodiscard]] std::vector<std::uint32_t> missing_units() const
    {
        std::vector<std::uint32_t> missing;
        for (std::uint32_t number = 1; number <= unit_count_; ++number) {
            if (!numbers_.contains(number)) {
                missing.push_back(number);
            }
        }
        return missing;
    }
    [[nodiscard]] std::uint32_t unit_count() const { return unit_count_; }

private:
    void admit_unit(const Input& input, UnitSummary unit)
    {
        if (first_unit_ && unit.mark.plan != first_unit_->mark.plan) {
            refuse_input(input.path,
                         fmt::format("belongs to {}, and {} to {}: merge the units of one plan",
                                     plan_text_of(unit), first_unit_path_.string(),
                                     plan_text_of(*first_unit_)));
        }
        require_same(input, unit.description);
        const bool is_new = numbers_.insert(unit.description.shard.index).second;
        repeated_ += is_new ? 0 : 1;
        if (is_new && first_unit_) {
            for (const RunNote& of_unit : unit.description.notes) {
                add_notes(first_->notes, of_unit.scene, std::span{&of_unit.note, 1},
                          of_unit.configurations);
            }
        }
        if (!first_unit_) {
            unit_count_ = unit.description.shard.count;
            first_unit_path_ = input.path;
            first_unit_ = std::move(unit);
        }
    }

    void require_same(const Input& input, const RunDescription& description)
    {
        if (description.size == 0) {
            refuse_input(input.path, "no configuration is planned in it: leave it out");
        }
        if (!first_) {
            first_ = description;
            first_path_ = input.path;
            return;
        }
        if (description.size != first_->size || description.axes != first_->axes ||
            description.lights != first_->lights) {
            refuse_input(input.path, fmt::format("belongs to another sweep than {}: merge the "
                                                 "parts of one sweep",
                                                 first_path_.string()));
        }
        if (environments_ == Environments::one &&
            !are_equal(description.environment, first_->environment)) {
            refuse_input(input.path,
                         fmt::format("was computed in another environment ({}) than {} ({}): leave "
                                     "it out, or pass --allow-mixed",
                                     environment_text(description.environment),
                                     first_path_.string(), environment_text(first_->environment)));
        }
    }

    Environments environments_;
    std::optional<RunDescription> first_;
    std::filesystem::path first_path_;
    std::optional<UnitSummary> first_unit_;
    std::filesystem::path first_unit_path_;
    std::set<std::uint32_t> numbers_; ///< of the units seen
    std::uint32_t unit_count_ = 0;
    std::uint64_t repeated_ = 0;
    std::vector<std::string> damaged_; ///< a message for each
};

/// Deletes what an interrupted merge left.
/// @throws scene::InputError  if the database holds a run.
void clear_interrupted_merge(const Database& database, const std::filesystem::path& out)
{
    if (read_description(database).size != 0) {
        refuse_input(out, "holds a run already: name a new folder");
    }
    Transaction transaction{database};
    for (const char* const table : {"map_errors", "verifications", "curve_bins", "curve_points",
                                    "plan", "configurations", "curves", "environments", "run"}) {
        database.run(fmt::format("DELETE FROM {}", table));
    }
    transaction.commit();
}

void require_one_environment(const Database& database, const std::filesystem::path& out)
{
    const auto count = database.integer("SELECT count(DISTINCT environment) FROM configurations"
                                        " WHERE environment IS NOT NULL");
    if (count > 1) {
        refuse_input(out,
                     fmt::format("the runs hold results of {} environments: pass --allow-mixed to "
                                 "keep them together",
                                 count));
    }
}

} // namespace

MergeOutcome merge_runs(const std::filesystem::path& out,
                        std::span<const std::filesystem::path> runs, Environments environments)
{
    if (runs.empty()) {
        throw std::invalid_argument("merge_runs: no runs");
    }
    InputCheck check{environments};
    std::vector<Input> inputs = inputs_of(runs);
    std::erase_if(inputs, [&](const Input& input) { return !check.admit(input); });
    if (inputs.empty()) {
        throw scene::InputError(check.damaged().front());
    }
    Database database{results_path(out), Database::Access::write};
    prepare_run(database);
    clear_interrupted_merge(database, out);
    // An interrupted merge starts again, so only the last transaction must reach the disk.
    database.run("PRAGMA synchronous = NORMAL");
    for (const Input& input : inputs) {
        merge_into(database, input.database(), input.path);
    }
    database.run("PRAGMA synchronous = FULL");
    if (environments == Environments::one) {
        require_one_environment(database, out);
    }
    RunDescription description = check.description();
    description.shard = {};
    Transaction transaction{database};
    write_description(database, description);
    PlanOutcome counts = read_outcome(database);
    transaction.commit();
    counts.planned = description.size - counts.done - counts.failed;
    write_run_csv(database, out);
    return {counts, check.damaged(), check.repeated(), check.missing_units(), check.unit_count()};
}

} // namespace gnomon::store
