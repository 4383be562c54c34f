#include "cli/units/cluster_sweep.hpp"

#include "cli/options/job_options.hpp"
#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"
#include "cli/units/cluster_driver.hpp"
#include "cli/units/planned_sweep.hpp"
#include "scene/error.hpp"
#include "store/output_file.hpp"
#include "store/run_folder/run_lock.hpp"
#include "store/units/merged_run.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;
using store::PlannedUnit;
using Kind = ClusterEvent::Kind;

class ClusterSweep {
public:
    explicit ClusterSweep(const ClusterSweepOptions& options)
        : options_{options},
          cluster_{read_cluster(options.cluster)},
          scenes_{cluster_.shares_files ? fs::path{} : fs::absolute(options.folder) / "scenes"},
          plan_{plan_sweep(options.job, options.axes, options.units, scenes_)},
          lock_{options.folder},
          run_{options.folder, description(),
               options.allows_mixed ? store::Environments::several : store::Environments::one,
               options.retries_failed ? store::Failures::tried_again : store::Failures::kept},
          units_{fs::absolute(options.folder) / "units"}
    {
    }

    api::SweepOutcome run()
    {
        stop_on_signals();
        begin();
        const std::vector<const PlannedUnit*> missing = missing_units();
        if (!is_interrupted() && !missing.empty()) {
            compute(missing);
        }
        progress_.reset();
        run_.write_csv();
        outcome_.is_interrupted = is_interrupted();
        const store::PlanOutcome counts = run_.outcome();
        outcome_.configurations = plan_.size;
        outcome_.done = counts.done;
        outcome_.failed = counts.failed;
        outcome_.retriable = run_.retriable();
        outcome_.checks = run_.checks();
        if (counts.done + counts.failed == plan_.size) {
            std::error_code none;
            fs::remove_all(units_, none); // the run holds all results
            if (!scenes_.empty()) {
                fs::remove_all(scenes_, none);
            }
        }
        return outcome_;
    }

private:
    [[nodiscard]] store::RunDescription description() const
    {
        const scene::SweepSpace space = space_of(plan_.job);
        store::RunDescription description;
        description.environment.gnomon = GNOMON_VERSION;
        description.size = plan_.size;
        description.axes = space.distinctions();
        description.lights = space.lights();
        description.job = plan_.job.text.empty() ? job_text(options_.job) : plan_.job.text;
        description.command = options_.command;
        description.compare_command = plan_.compare_command;
        return description;
    }

    [[nodiscard]] fs::path plan_file() const { return units_ / "plan.jsonl"; }

    /// Merges units that an earlier command left; removes those of another plan.
    void begin()
    {
        const std::string text = store::plan_text(plan_);
        std::error_code none;
        const bool is_same =
            fs::exists(plan_file(), none) && store::read_unit_plan(plan_file()).id == plan_.id;
        if (!is_same) {
            fs::remove_all(units_);
            fs::create_directories(units_);
        }
        store::write_file(plan_file(), text);
        for (const fs::path& file : store::unit_files(units_)) {
            take(file);
        }
    }

    /// Merges a unit's file into the run and removes it. A damaged unit will be computed again.
    void take(const fs::path& file)
    {
        try {
            const store::UnitSummary unit = run_.take(file, plan_.id);
            fs::remove(file);
            finished_.insert(unit.mark.unit);
            if (progress_) {
                progress_->add(unit.outcome.done, unit.outcome.failed);
            }
        } catch (const store::sqlite::DamagedDatabase&) {
            fs::remove(file);
        }
    }

    [[nodiscard]] std::vector<const PlannedUnit*> missing_units() const
    {
        std::vector<const PlannedUnit*> missing;
        for (const PlannedUnit& unit : plan_.units) {
            if (!finished_.contains(unit.id) && !run_.has(unit)) {
                missing.push_back(&unit);
            }
        }
        return missing;
    }

    void compute(const std::vector<const PlannedUnit*>& missing)
    {
        std::uint64_t total = 0;
        for (const PlannedUnit* unit : missing) {
            total += unit->configurations;
        }
        progress_ = std::make_unique<Progress>(total, plan_.size - total, options_.is_quiet);
        ClusterDriver driver{cluster_,
                             {plan_file(), units_, scenes_, options_.threads, options_.allows_mixed,
                              options_.retries_failed},
                             missing};
        try {
            follow(driver);
        } catch (...) {
            driver.stop(); // else remote workers would go on
            throw;
        }
    }

    /// Merges units as they arrive, until the driver ends or the user interrupts.
    void follow(ClusterDriver& driver)
    {
        while (!is_interrupted()) {
            const ClusterEvent event = driver.next();
            if (event.kind == Kind::ended) {
                return;
            }
            handle(event);
        }
        driver.stop();
        for (const fs::path& file : store::unit_files(units_)) {
            take(file);
        }
    }

    void handle(const ClusterEvent& event)
    {
        if (event.kind == Kind::unit) {
            progress_->begin(fmt::format("unit {} on {}", event.subject, event.text));
            take(store::unit_path(units_, event.subject));
        } else if (event.kind == Kind::failed) {
            fmt::print(stderr, "gnomon: unit {}: {}\n", event.subject, event.text);
        } else if (event.kind == Kind::worker) {
            progress_->begin(fmt::format("worker {} with {}", event.subject, event.text));
        }
    }

    const ClusterSweepOptions& options_;
    Cluster cluster_;
    fs::path scenes_; ///< packed scenes for workers without the files; may be empty
    store::UnitPlan plan_;
    store::RunLock lock_;
    store::MergedRun run_;
    fs::path units_; ///< where the driver puts units' files
    std::set<std::string> finished_;
    std::unique_ptr<Progress> progress_; ///< while units are computed
    api::SweepOutcome outcome_;
};

} // namespace

api::SweepOutcome sweep_on_cluster(const ClusterSweepOptions& options)
{
    return ClusterSweep{options}.run();
}

} // namespace gnomon::cli
