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
/// What `record` and `record_failure` return from is on the disk: it survives the end of the
/// process and of the power. One process writes a run at a time (`RunLock`), any number read it
/// meanwhile. A store is used by one thread at a time.
///
/// Ordinals are those of the plan. Two ordinals may have the same id, where two values of an axis
/// amount to the same job: they share one result, and each has its row in the CSV.
///
/// Every function throws
///   scene::EnvironmentError  if the disk is full, the folder cannot be written, or reading or
///                            writing fails: what was recorded before stays;
///   scene::InputError        if the database turns out to be damaged.
class RunStore {
public:
    enum class Access : std::uint8_t {
        read,
        read_older, ///< runs of older schemas, too (`prepare_reading`)
        write,
    };

    /// Opens the run; with `write`, makes its database where there is none.
    /// @throws scene::InputError  if there is nothing to read, or the file is no database of
    ///                            results, or one of another schema.
    RunStore(const std::filesystem::path& folder, Access access);
    RunStore(RunStore&&) noexcept;
    RunStore& operator=(RunStore&&) noexcept;
    ~RunStore();

    /// Records what the run is to compute, in place of an earlier plan. Configurations with a known
    /// id keep their state and results.
    ///
    /// @param configurations  Of the whole sweep, or of this part alone; ordinals occur once. Those
    ///                        whose `shard` is not the description's are other parts': recorded,
    ///                        so that `merge` knows the whole, and left out of all else here.
    /// @throws scene::InputError  if it holds results of another environment and several are not
    ///                            allowed, or of other scenes alone and those may not be replaced.
    /// @throws std::invalid_argument  if an ordinal occurs twice, a key is no job key, or the shard
    ///                                is none.
    PlanOutcome plan(const RunDescription& description,
                     std::span<const analysis::Configuration> configurations,
                     Environments environments = Environments::one,
                     OtherScenes other_scenes = OtherScenes::replaced);
    /// The same for a plan that does not fit into memory.
    PlanOutcome plan(const RunDescription& description, const ShowConfigurations& show,
                     Environments environments = Environments::one,
                     OtherScenes other_scenes = OtherScenes::replaced);

    /// The run's schema: the present one unless it was opened with `read_older`.
    [[nodiscard]] const RunSchema& schema() const;

    /// Whether anything was ever planned here.
    [[nodiscard]] bool has_configurations() const;

    /// What was planned; its environment is that of the last plan.
    [[nodiscard]] RunDescription description() const;

    /// Ordinals of this part's configurations in that state, ascending.
    [[nodiscard]] std::vector<std::uint64_t> ordinals(RunState state) const;

    /// The first `most` of this part's configurations in that state, by ordinal.
    [[nodiscard]] std::vector<RunRow> rows(RunState state, std::uint64_t most) const;

    /// How the plan's configurations stand.
    [[nodiscard]] PlanOutcome outcome() const;

    /// Ordinals of this part's finished configurations whose curve was not held to GL's reruns,
    /// ascending.
    [[nodiscard]] std::vector<std::uint64_t> unverified() const;

    /// Of finished curves that lack the errors by distance at a job's bias, for each such bias the
    /// first ordinal of this part that asks for it, ascending.
    [[nodiscard]] std::vector<std::uint64_t> without_job_bias() const;

    /// Ordinals of this part that repeat an earlier one: the same id and the same bias of the job,
    /// so that one result serves both. Ascending.
    [[nodiscard]] std::vector<std::uint64_t> repeated() const;

    /// What the checks of this part's results found.
    [[nodiscard]] RunChecks checks() const;

    /// Makes failed configurations planned again; returns how many of this part's ordinals that is.
    std::uint64_t reset_failed();

    /// Records a curve and its configurations, which are done then: all of it or nothing.
    /// @throws std::invalid_argument  if an ordinal is not planned, or is of another curve.
    void record(const analysis::FinishedCurve& curve);

    /// Records why configurations failed. Those that are done stay done.
    /// @throws std::invalid_argument  if an ordinal is not planned.
    void record_failure(std::span<const std::uint64_t> ordinals, const std::string& message,
                        analysis::Retry retry = analysis::Retry::may_help);

    /// How many failed configurations of this part may pass when they are tried again.
    [[nodiscard]] std::uint64_t retriable() const;

    /// Writes RUN/results.csv, RUN/error_vs_z.csv and RUN/bias_curves.csv, and RUN/by_map.csv where
    /// a configuration of a light with several maps is done (docs/csv_schema.md), each atomically:
    /// the rows of this part, in the order of their ordinals. The same results give the same bytes.
    void write_csv() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::store
