#pragma once

#include "analysis/environment.hpp"
#include "analysis/results/results.hpp"
#include "store/run/run_checks.hpp"
#include "store/run/run_schema.hpp"
#include "store/run/run_types.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::store {

/// The results of a sweep on the disk: RUN/results.sqlite (docs/runs.md).
///
/// When `record` or `record_failure` returns, the data survives a crash and a power failure. One
/// process writes a run at a time (`RunLock`); any number may read it meanwhile. Only one thread
/// may use a store at a time.
///
/// Ordinals number the plan. If two values of an axis give the same job, two ordinals have the same
/// id: they share one result, and each has its row in the CSV.
///
/// Every function throws
///   scene::EnvironmentError  if the disk is full, the folder cannot be written, or reading or
///                            writing fails; earlier records stay;
///   scene::InputError        if the database is damaged.
class RunStore {
public:
    enum class Access : std::uint8_t {
        read,
        read_older, ///< also reads older schemas (`prepare_reading`)
        write,
    };

    /// Opens the run; `write` creates a missing database.
    /// @throws scene::InputError  if there is no database to read, or it does not hold results, or
    ///                            has another schema.
    RunStore(const std::filesystem::path& folder, Access access);
    RunStore(RunStore&&) noexcept;
    RunStore& operator=(RunStore&&) noexcept;
    ~RunStore();

    /// Replaces the plan. Configurations with a known id keep their state and results.
    ///
    /// @param configurations  of the whole sweep, or of this part; each ordinal once. Those with
    ///                        another `shard` than the description's belong to other parts: they
    ///                        are recorded for `merge`, and every other function ignores them.
    /// @throws scene::InputError  if results of another environment or only of other scenes exist,
    ///                            and that is not allowed.
    /// @throws std::invalid_argument  if an ordinal occurs twice, a key is unknown, or the shard is
    ///                                invalid.
    PlanOutcome plan(const RunDescription& description,
                     std::span<const analysis::Configuration> configurations,
                     Environments environments = Environments::one,
                     OtherScenes other_scenes = OtherScenes::replaced);
    /// As above, for a plan that does not fit into memory.
    PlanOutcome plan(const RunDescription& description, const ShowConfigurations& show,
                     Environments environments = Environments::one,
                     OtherScenes other_scenes = OtherScenes::replaced);

    /// The present schema, unless the run was opened with `read_older`.
    [[nodiscard]] const RunSchema& schema() const;

    /// Whether any configuration was ever planned.
    [[nodiscard]] bool has_configurations() const;

    /// The last plan's description and environment.
    [[nodiscard]] RunDescription description() const;

    /// The ordinals of this part's configurations in a state, ascending.
    [[nodiscard]] std::vector<std::uint64_t> ordinals(RunState state) const;

    /// The first `most` configurations of this part in a state, by ordinal.
    [[nodiscard]] std::vector<RunRow> rows(RunState state, std::uint64_t most) const;

    /// Counts this part's configurations by state.
    [[nodiscard]] PlanOutcome outcome() const;

    /// The ordinals of this part's finished configurations whose curve was not checked against
    /// reruns by GL, ascending.
    [[nodiscard]] std::vector<std::uint64_t> unverified() const;

    /// Finds finished curves that lack the errors by distance at a job's bias. Returns this part's
    /// first ordinal for each such curve and bias, ascending.
    [[nodiscard]] std::vector<std::uint64_t> without_job_bias() const;

    /// The ordinals of this part that share id and job bias with an earlier one, and so its result;
    /// ascending.
    [[nodiscard]] std::vector<std::uint64_t> repeated() const;

    [[nodiscard]] RunChecks checks() const;

    /// Sets failed configurations back to planned; returns the number of this part's ordinals
    /// affected.
    std::uint64_t reset_failed();

    /// Records a curve and its configurations, all or nothing, and marks them done.
    /// @throws std::invalid_argument  if an ordinal is not planned, or belongs to another curve.
    void record(const analysis::FinishedCurve& curve);

    /// Records why configurations failed. Done configurations stay done.
    /// @throws std::invalid_argument  if an ordinal is not planned.
    void record_failure(std::span<const std::uint64_t> ordinals, const std::string& message,
                        analysis::Retry retry = analysis::Retry::may_help);

    /// The number of this part's failed configurations that may pass when tried again.
    [[nodiscard]] std::uint64_t retriable() const;

    /// Writes RUN/results.csv, RUN/error_vs_z.csv and RUN/bias_curves.csv, each atomically
    /// (docs/csv_schema.md); also RUN/by_map.csv if a finished light has several maps. Rows are
    /// this part's, by ordinal. Equal results give equal bytes.
    void write_csv() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::store
