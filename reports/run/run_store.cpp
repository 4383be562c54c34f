#include "reports/run/run_store.hpp"

#include "reports/run/run_csv.hpp"
#include "reports/run/run_plan.hpp"
#include "reports/run/run_recorder.hpp"
#include "reports/run/run_schema.hpp"
#include "scene/error.hpp"
#include "scene/job_toml.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace gnomon::reports {

namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

constexpr std::array<std::string_view, 3> state_names{"planned", "done", "failed"};

void require_results(const std::filesystem::path& folder)
{
    std::error_code error;
    if (!std::filesystem::exists(results_path(folder), error)) {
        throw scene::InputError(
            fmt::format("{}: there is no results.sqlite in it: name the folder that `gnomon "
                        "sweep --out` or `gnomon merge` wrote",
                        scene::one_line(folder.string())));
    }
}

void prepare_writing(const Database& database)
{
    database.enter_wal_mode();
    database.run("PRAGMA cache_size = -32768"); // KiB
    Transaction transaction{database};
    if (database.integer("SELECT count(*) FROM sqlite_schema") == 0) {
        create_run_schema(database);
    }
    transaction.commit();
}

} // namespace

/// The database, and what is kept of it between calls.
struct RunStore::Parts {
    Parts(const std::filesystem::path& run, Access run_access)
        : folder{run},
          access{run_access},
          database{results_path(run),
                   access == Access::write ? Database::Access::write : Database::Access::read}
    {
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    ~Parts()
    {
        kept_recorder.reset(); // a statement would keep the journal in use
        if (access == Access::write) {
            database.leave_wal_mode();
        }
    }

    RunRecorder& recorder()
    {
        return kept_recorder ? *kept_recorder : kept_recorder.emplace(database);
    }

    std::filesystem::path folder;
    Access access;
    Database database;
    std::optional<RunRecorder> kept_recorder;
    std::int64_t environment = 0; ///< number of the plan's
};

RunStore::RunStore(const std::filesystem::path& folder, Access access)
{
    if (access == Access::read) {
        require_results(folder);
    }
    parts_ = std::make_unique<Parts>(folder, access);
    if (access == Access::write) {
        prepare_writing(parts_->database);
    }
    require_run_schema(parts_->database);
    if (access == Access::write) {
        parts_->database.require_sound();
    }
    parts_->environment = environment_number(parts_->database);
}

RunStore::RunStore(RunStore&&) noexcept = default;
RunStore& RunStore::operator=(RunStore&&) noexcept = default;
RunStore::~RunStore() = default;

PlanOutcome RunStore::plan(const RunDescription& description,
                           std::span<const analysis::Configuration> configurations,
                           Environments environments)
{
    std::size_t i = 0;
    const auto next = [&]() -> std::optional<analysis::Configuration> {
        return i < configurations.size() ? std::optional{configurations[i++]} : std::nullopt;
    };
    return plan(description, next, environments);
}

PlanOutcome RunStore::plan(const RunDescription& description, const NextConfiguration& next,
                           Environments environments)
{
    const PlanOutcome outcome = write_plan(parts_->database, description, next, environments);
    parts_->environment = environment_number(parts_->database);
    return outcome;
}

RunDescription RunStore::description() const
{
    return read_description(parts_->database);
}

std::vector<std::uint64_t> RunStore::ordinals(RunState state) const
{
    Statement find{parts_->database,
                   "SELECT p.ordinal FROM part p CROSS JOIN configurations c"
                   " ON c.number = p.configuration WHERE c.status = ? ORDER BY p.ordinal"};
    find.bind(1, state_names[static_cast<std::size_t>(state)]);
    std::vector<std::uint64_t> ordinals;
    while (find.step()) {
        ordinals.push_back(static_cast<std::uint64_t>(find.integer(0)));
    }
    return ordinals;
}

std::uint64_t RunStore::reset_failed()
{
    const std::uint64_t count = ordinals(RunState::failed).size();
    parts_->database.run("UPDATE configurations SET status = 'planned', message = NULL"
                         " WHERE status = 'failed'"
                         " AND number IN (SELECT configuration FROM part)");
    return count;
}

void RunStore::record(const analysis::FinishedCurve& curve)
{
    parts_->recorder().record(curve, parts_->environment);
}

void RunStore::record_failure(std::span<const std::uint64_t> ordinals, const std::string& message)
{
    parts_->recorder().record_failure(ordinals, message);
}

void RunStore::write_csv() const
{
    write_run_csv(parts_->database, parts_->folder);
}

} // namespace gnomon::reports
