#pragma once

#include "analysis/renderers.hpp"
#include "analysis/sweep/results.hpp"
#include "scene/scene_notes.hpp"
#include "store/run/run_checks.hpp"
#include "store/run/run_schema.hpp"

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

/// Which part of a divided sweep a run computes; 1 of 1 is all of it.
struct Shard {
    std::uint32_t index = 1; ///< from 1
    std::uint32_t count = 1;

    friend bool operator==(const Shard&, const Shard&) = default;
};

/// A note on a scene of the run.
struct RunNote {
    std::string scene; ///< its name
    scene::SceneNote note;
    std::uint64_t configurations = 0; ///< of the sweep, that it is about

    friend bool operator==(const RunNote&, const RunNote&) = default;
};

/// What a run is: recorded beside its results.
struct RunDescription {
    analysis::Environment environment;
    Shard shard;
    std::uint64_t size = 0; ///< configurations of the sweep, of all its parts
    /// The keys that the sweep varies, and `light` where the job has several: they name a
    /// configuration.
    std::vector<std::string> axes;
    std::string job; ///< the job file's text, or what stands for it
    /// The command that computes it, quoted for a shell, without --out and --shard:
    /// "gnomon sweep job.toml --axis bias.slope=[0,1]".
    std::string command;
    /// The command that computes one configuration, but for its case and its values of the axes:
    /// "gnomon compare job.toml".
    std::string compare_command = {};
    std::vector<RunNote> notes = {};      ///< none in runs of before there were notes
    std::vector<std::string> lights = {}; ///< names; of each every combination of axes is a
                                          ///< configuration; empty: one light
};

/// How a configuration stands.
enum class RunState : std::uint8_t {
    planned = 0, ///< nothing is known of it yet
    done = 1,
    failed = 2,
};

/// A configuration, as far as it takes to tell it from the others.
struct RunRow {
    std::uint64_t ordinal = 0;
    std::string id;
    std::string case_name;                                 ///< empty without cases
    std::string message;                                   ///< why it failed
    std::vector<std::pair<std::string, std::string>> axes; ///< the sweep's keys and their values
};

/// How the configurations of a plan stand.
struct PlanOutcome {
    std::uint64_t done = 0;    ///< of this part's configurations: they are not to be computed again
    std::uint64_t failed = 0;  ///< of this part's
    std::uint64_t planned = 0; ///< of this part's
    std::uint64_t retired = 0; ///< of `plan`: results in the database that it does not ask for
    bool has_equal_ids = false; ///< of `plan`: two ordinals have the same id
};

using VisitConfiguration = std::function<void(const analysis::Configuration&)>;
/// Shows the configurations of a plan one by one: all of them may be too many for the memory.
using ShowConfigurations = std::function<void(const VisitConfiguration& visit)>;

/// How many environments the results of one run may come from.
enum class Environments : std::uint8_t { one, several };

/// Whether a plan may take the place of one that has results of other scenes alone.
enum class OtherScenes : std::uint8_t { refused, replaced };

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
