#include "store/run/run_store.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/csv/csv_text.hpp"
#include "store/csv/run_csv.hpp"
#include "store/run/run_columns.hpp"
#include "store/run/run_plan.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_recorder.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace gnomon::store {

namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr std::uint64_t most_rows = std::numeric_limits<std::int64_t>::max();

constexpr std::array<std::string_view, 3> state_names{"planned", "done", "failed"};

void require_results(const std::filesystem::path& folder)
{
    std::error_code error;
    if (!std::filesystem::exists(results_path(folder), error)) {
        throw scene::InputError(
            fmt::format("{}: there is no results.sqlite in it: name the folder that `gnomon "
                        "sweep --out`, `compare --out` or `gnomon merge` wrote",
                        scene::one_line(folder.string())));
    }
}

/// The axes in column order.
std::vector<std::string> axis_columns(const std::vector<std::string>& axes)
{
    std::vector<std::string> columns = light_columns(axes);
    for (const JobColumn& column : job_columns()) {
        if (std::ranges::find(axes, column.name) != axes.end()) {
            columns.push_back(column.name);
        }
    }
    return columns;
}

/// The first column of every row.
std::vector<std::uint64_t> integers(Statement find)
{
    std::vector<std::uint64_t> all;
    while (find.step()) {
        all.push_back(static_cast<std::uint64_t>(find.integer(0)));
    }
    return all;
}

} // namespace

/// The database and what calls reuse.
struct RunStore::State {
    State(const std::filesystem::path& run, Access access)
        : folder{run},
          database{results_path(run),
                   access == Access::write ? Database::Access::write : Database::Access::read}
    {
    }

    RunRecorder& recorder()
    {
        return kept_recorder ? *kept_recorder : kept_recorder.emplace(database);
    }

    std::filesystem::path folder;
    Database database;
    std::optional<RunRecorder>
        kept_recorder;            ///< destroyed before the database, as its statements must be
    std::int64_t environment = 0; ///< number of the plan's environment
    RunSchema schema;
};

RunStore::RunStore(const std::filesystem::path& folder, Access access)
{
    if (access != Access::write) {
        require_results(folder);
    }
    state_ = std::make_unique<State>(folder, access);
    if (access == Access::write) {
        prepare_run(state_->database);
    } else if (access == Access::read_older) {
        state_->schema = prepare_reading(state_->database);
    } else {
        require_run_schema(state_->database);
    }
    state_->environment = environment_number(state_->database);
}

RunStore::RunStore(RunStore&&) noexcept = default;
RunStore& RunStore::operator=(RunStore&&) noexcept = default;
RunStore::~RunStore() = default;

PlanOutcome RunStore::plan(const RunDescription& description,
                           std::span<const analysis::Configuration> configurations,
                           Environments environments, OtherScenes other_scenes)
{
    const auto show = [&](const VisitConfiguration& visit) {
        std::for_each(configurations.begin(), configurations.end(), visit);
    };
    return plan(description, show, environments, other_scenes);
}

PlanOutcome RunStore::plan(const RunDescription& description, const ShowConfigurations& show,
                           Environments environments, OtherScenes other_scenes)
{
    const PlanOutcome outcome =
        write_plan(state_->database, description, show, environments, other_scenes);
    state_->environment = environment_number(state_->database);
    return outcome;
}

const RunSchema& RunStore::schema() const
{
    return state_->schema;
}

bool RunStore::has_configurations() const
{
    return store::has_configurations(state_->database);
}

RunDescription RunStore::description() const
{
    return read_description(state_->database);
}

std::vector<std::uint64_t> RunStore::ordinals(RunState state) const
{
    Statement find{state_->database,
                   "SELECT p.ordinal FROM part p CROSS JOIN configurations c"
                   " ON c.number = p.configuration WHERE c.status = ? ORDER BY p.ordinal"};
    find.bind(1, state_names[static_cast<std::size_t>(state)]);
    return integers(std::move(find));
}

std::vector<RunRow> RunStore::rows(RunState state, std::uint64_t most) const
{
    const std::vector<std::string> axes = axis_columns(description().axes);
    std::string columns;
    for (const std::string& axis : axes) {
        columns += ", " + sqlite::sql_name(axis);
    }
    Statement find{state_->database,
                   fmt::format("SELECT ordinal, id, \"case\", message{} FROM results"
                               " WHERE status = ? ORDER BY ordinal LIMIT ?",
                               columns)};
    find.bind(1, state_names[static_cast<std::size_t>(state)])
        .bind(2, static_cast<std::int64_t>(std::min(most, most_rows)));
    std::vector<RunRow> rows;
    while (find.step()) {
        RunRow row{static_cast<std::uint64_t>(find.integer(0)),
                   find.text(1),
                   find.text(2),
                   find.text(3),
                   {}};
        for (std::size_t i = 0; i < axes.size(); ++i) {
            row.axes.emplace_back(axes[i], cell_text(find.value(4 + static_cast<int>(i))));
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

PlanOutcome RunStore::outcome() const
{
    return read_outcome(state_->database);
}

std::vector<std::uint64_t> RunStore::unverified() const
{
    return integers({state_->database,
                     "SELECT p.ordinal FROM part p CROSS JOIN configurations c"
                     " ON c.number = p.configuration JOIN curves v ON v.number = c.curve"
                     " WHERE c.status = 'done' AND v.bias_source = 'curve'"
                     " AND v.number NOT IN (SELECT curve FROM verifications) ORDER BY p.ordinal"});
}

std::vector<std::uint64_t> RunStore::without_job_bias() const
{
    // A curve without scored pixels has no bins at any bias.
    return integers({state_->database,
                     "SELECT a.first FROM (SELECT c.curve, p.job_bias, min(p.ordinal) AS first"
                     " FROM part p CROSS JOIN configurations c ON c.number = p.configuration"
                     " WHERE c.status = 'done' GROUP BY c.curve, p.job_bias) a"
                     " JOIN curves v ON v.number = a.curve WHERE v.lit + v.blocked > 0"
                     " AND NOT EXISTS (SELECT 1 FROM curve_bins b WHERE b.curve = a.curve"
                     " AND b.job_bias = a.job_bias AND b.\"at\" = 'job_bias') ORDER BY a.first"});
}

std::vector<std::uint64_t> RunStore::repeated() const
{
    return integers({state_->database,
                     "SELECT ordinal FROM (SELECT ordinal, row_number() OVER"
                     " (PARTITION BY configuration, job_bias ORDER BY ordinal) AS place FROM part)"
                     " WHERE place > 1 ORDER BY ordinal"});
}

RunChecks RunStore::checks() const
{
    return read_run_checks(state_->database);
}

std::uint64_t RunStore::reset_failed()
{
    const std::uint64_t count = ordinals(RunState::failed).size();
    state_->database.run("UPDATE configurations SET status = 'planned', message = NULL,"
                         " may_pass = NULL"
                         " WHERE status = 'failed'"
                         " AND number IN (SELECT configuration FROM part)");
    return count;
}

void RunStore::record(const analysis::FinishedCurve& curve)
{
    state_->recorder().record(curve, state_->environment);
}

void RunStore::record_failure(std::span<const std::uint64_t> ordinals, const std::string& message,
                              analysis::Retry retry)
{
    state_->recorder().record_failure(ordinals, message, retry);
}

std::uint64_t RunStore::retriable() const
{
    return read_retriable(state_->database);
}

void RunStore::write_csv() const
{
    write_run_csv(state_->database, state_->folder);
}

} // namespace gnomon::store
