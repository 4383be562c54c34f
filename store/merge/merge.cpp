#include "store/merge/merge.hpp"

#include "scene/error.hpp"
#include "scene/one_line.hpp"
#include "store/csv/run_csv.hpp"
#include "store/merge/merge_sql.hpp"
#include "store/run/run_plan.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

namespace {

using analysis::Environment;
using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

[[noreturn]] void refuse_run(const std::filesystem::path& run, std::string_view what)
{
    throw scene::InputError(scene::one_line(fmt::format("{}: {}", run.string(), what)));
}

bool are_equal(const Environment& a, const Environment& b)
{
    return a.gl_renderer == b.gl_renderer && a.gl_version == b.gl_version && a.embree == b.embree &&
           a.gnomon == b.gnomon;
}

std::string text_of(const Environment& environment)
{
    return fmt::format("{}, GL {}, {}, {}", environment.gl_renderer, environment.gl_version,
                       environment.embree, environment.gnomon);
}

/// The runs' descriptions, which agree as far as they must.
std::vector<RunDescription> read_descriptions(std::span<const std::filesystem::path> runs,
                                              Environments environments)
{
    std::vector<RunDescription> all;
    for (const std::filesystem::path& run : runs) {
        all.push_back(RunStore{run, RunStore::Access::read}.description());
        const RunDescription& first = all.front();
        const RunDescription& last = all.back();
        if (last.size == 0) {
            refuse_run(run, "nothing was planned in it: leave it out");
        }
        if (last.size != first.size || last.axes != first.axes || last.lights != first.lights) {
            refuse_run(run, fmt::format("is of another sweep than {}: merge the parts of one",
                                        runs.front().string()));
        }
        if (environments == Environments::one && !are_equal(last.environment, first.environment)) {
            refuse_run(run, fmt::format("was computed in another environment ({}) than {} ({}): "
                                        "leave it out, or pass --allow-mixed",
                                        text_of(last.environment), runs.front().string(),
                                        text_of(first.environment)));
        }
    }
    return all;
}

/// Takes away what a merge left that was cut short.
/// @throws scene::InputError  if it holds a run.
void require_vacant(const Database& database, const std::filesystem::path& out)
{
    if (read_description(database).size != 0) {
        refuse_run(out, "holds a run already: name a new folder");
    }
    Transaction transaction{database};
    for (const char* const table : {"map_errors", "verifications", "curve_bins", "curve_points",
                                    "plan", "configurations", "curves", "environments", "run"}) {
        database.run(fmt::format("DELETE FROM {}", table));
    }
    transaction.commit();
}

void require_same_sweep(const Database& database, const std::filesystem::path& run)
{
    Statement find{database, merge_sql::other_plan()};
    if (find.step()) {
        refuse_run(run,
                   fmt::format("is of another sweep than the runs before it: its configuration "
                               "{} is another; merge the parts of one",
                               find.integer(0)));
    }
}

void require_no_conflict(const Database& database, const std::filesystem::path& run)
{
    std::vector<merge_sql::Conflict> conflicts = merge_sql::conflicts();
    if (has_map_errors(database, "input")) {
        conflicts.push_back(merge_sql::map_conflict());
    }
    for (const merge_sql::Conflict& conflict : conflicts) {
        Statement find{database, conflict.query};
        if (find.step()) {
            refuse_run(run,
                       fmt::format("{} {} has another {} than in the runs before it: leave one "
                                   "of them out",
                                   conflict.subject, find.text(0), find.text(1)));
        }
    }
}

/// Adds a run to the union.
void unite(const Database& database, const std::filesystem::path& run)
{
    database.attach(results_path(run), "input");
    {
        Transaction transaction{database};
        require_same_sweep(database, run);
        require_no_conflict(database, run);
        for (const std::string& statement : merge_sql::union_statements()) {
            database.run(statement);
        }
        if (has_map_errors(database, "input")) {
            database.run(merge_sql::new_map_errors());
        }
        transaction.commit();
    }
    database.run("DETACH input");
}

void require_one_environment(const Database& database, const std::filesystem::path& out)
{
    const auto count = database.integer("SELECT count(DISTINCT environment) FROM configurations"
                                        " WHERE environment IS NOT NULL");
    if (count > 1) {
        refuse_run(out,
                   fmt::format("the runs hold results of {} environments: pass --allow-mixed to "
                               "keep them together",
                               count));
    }
}

} // namespace

PlanOutcome merge_runs(const std::filesystem::path& out,
                       std::span<const std::filesystem::path> runs, Environments environments)
{
    if (runs.empty()) {
        throw std::invalid_argument("merge_runs: no runs");
    }
    RunDescription description = read_descriptions(runs, environments).front();
    Database database{results_path(out), Database::Access::write};
    prepare_run(database);
    require_vacant(database, out);
    for (const std::filesystem::path& run : runs) {
        unite(database, run);
    }
    if (environments == Environments::one) {
        require_one_environment(database, out);
    }
    description.shard = {};
    Transaction transaction{database};
    write_description(database, description);
    PlanOutcome outcome = read_outcome(database);
    transaction.commit();
    outcome.planned = description.size - outcome.done - outcome.failed;
    write_run_csv(database, out);
    return outcome;
}

} // namespace gnomon::store
