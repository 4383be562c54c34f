#include "api/sweep/sweep.hpp"

#include "analysis/comparison/comparison.hpp"
#include "analysis/sweep/background_worker.hpp"
#include "analysis/sweep/configuration_id.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/units.hpp"
#include "api/compare.hpp"
#include "api/memory.hpp"
#include "api/sweep/sweep_scenes.hpp"
#include "raster_gl/context.hpp"
#include "reference_rt/truth.hpp"
#include "scene/error.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/run/run_record.hpp"
#include "store/run_folder/pixels.hpp"
#include "store/run_folder/run_lock.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

namespace gnomon::api {
namespace {

/// Errors by object and light distance take kilobytes per row. Only baselines use them, and no
/// baseline stores them for more rows.
constexpr std::uint64_t most_rows_with_cells = 2'000;

/// Limits of results that wait in memory to be recorded, in curves and in rows.
constexpr std::size_t most_waiting_curves = 16;
constexpr std::size_t most_waiting_rows = 16'384;

namespace fs = std::filesystem;
using analysis::Configuration;
using analysis::CurveRequest;
using analysis::Refusal;
using analysis::SweepCurves;
using store::RunState;
using store::RunStore;

/// The message of an error in the job; empty if there is none.
template <typename Work>
std::string refusal_of(const Work& work)
{
    try {
        work();
        return {};
    } catch (const scene::InputError& error) {
        return error.what();
    }
}

/// How many curves' results may wait to be recorded.
std::size_t waiting_curves(const std::vector<CurveRequest>& requests)
{
    std::size_t most_rows = 1;
    for (const CurveRequest& request : requests) {
        most_rows = std::max(most_rows, request.ordinals.size());
    }
    return std::clamp<std::size_t>(most_waiting_rows / most_rows, 1, most_waiting_curves);
}

SweepCurves curves_of(const scene::SweepSpace& space, const SweepRunOptions& options)
{
    return options.unit ? SweepCurves{space, options.unit->ordinals, GNOMON_VERSION}
                        : SweepCurves{space, options.keeps_pixels, GNOMON_VERSION};
}

class SweepRun {
public:
    SweepRun(const scene::SweepSpace& space, const SweepRunOptions& options,
             const SweepWatcher& watcher)
        : space_{space},
          options_{options},
          watcher_{watcher},
          lock_{options.unit ? nullptr : std::make_unique<store::RunLock>(options.folder)},
          sweep_curves_{curves_of(space, options)},
          refusals_{sweep_curves_.refusals()},
          context_{opened(options.session)},
          scenes_{*context_, options.session,
                  options.unit ? options.unit->normals : needed_normals(sweep_curves_),
                  options.unit ? options.unit->load_scene : SceneLoader{}},
          store_{options.folder, RunStore::Access::write}
    {
        if (options.session.threads > 0) {
            threads_.emplace(tbb::global_control::max_allowed_parallelism,
                             static_cast<std::size_t>(options.session.threads));
        }
    }

    SweepOutcome run()
    {
        read_scenes();
        start_planning();
        if (begins_at_once()) {
            select_all();
        } else {
            finish_recording();
            select_missing();
        }
        if (!requests_.empty() || !refusals_.empty()) {
            compute();
        }
        finish_recording();
        const auto write_csv = [&] {
            if (!options_.unit) {
                store_.write_csv();
            }
        };
        tbb::parallel_invoke(write_csv, [&] { read_outcome(); });
        return outcome_;
    }

private:
    /// Reads the scene of every request. Refuses requests whose scene cannot be read, or that need
    /// more memory than is available.
    void read_scenes()
    {
        std::map<std::string, std::pair<SceneContent, std::string>> known; // and error
        for (std::size_t i = 0; i < sweep_curves_.requests().size(); ++i) {
            const CurveRequest& request = sweep_curves_.requests()[i];
            const scene::Job job = sweep_curves_.job(i);
            const auto [entry, is_new] = known.try_emplace(request.keys.scene);
            auto& [content, error] = entry->second;
            if (is_new) {
                error = refusal_of([&] { content = scenes_.content(job); });
                if (options_.unit) {
                    options_.unit->check_scene(request.keys.scene, content);
                }
            }
            const std::string message =
                error.empty() ? refusal_of([&] { require_memory(job); }) : error;
            largest_need_bytes_ = std::max(largest_need_bytes_, needed_memory_bytes(job));
            store::add_notes(notes_, analysis::scene_name(job.scene),
                             content.notes[scene::left_to_file(job)], request.ordinals.size());
            identities_.push_back(
                analysis::identify_scene(job, content.hash, content.defaults, content.normals));
            is_refused_.push_back(!message.empty());
            if (!message.empty()) {
                refusals_.push_back({request.ordinals, message, analysis::Retry::may_help});
            }
        }
        // Another unit may have configurations that can be computed.
        if (!options_.unit && std::ranges::find(is_refused_, false) == is_refused_.end()) {
            throw scene::InputError(refusals_.front().message);
        }
    }

    /// Counts the states of all configurations, through its own connection, after all writes.
    void read_outcome()
    {
        const RunStore store{options_.folder, RunStore::Access::read};
        const store::PlanOutcome counts = store.outcome();
        outcome_.done = counts.done;
        outcome_.failed = counts.failed;
        outcome_.retriable = outcome_.failed > 0 ? store.retriable() : 0;
        outcome_.checks = store.checks();
    }

    /// Starts recording the plan; results are recorded after it.
    void start_planning()
    {
        const auto& requests = sweep_curves_.requests();
        std::vector<std::uint32_t> shards(requests.size(), options_.shard.index);
        if (!options_.unit) {
            const auto whole = analysis::make_plan(requests, analysis::camera_slots(requests));
            shards = analysis::divide(whole, requests, options_.shard.count);
            analysis::keep_equals_together(sweep_curves_, identities_, shards);
        }
        has_earlier_results_ = store_.has_configurations();
        recording_.add([this, shards = std::move(shards)] {
            planned_ = store_.plan(
                description(), [&](const auto& visit) { show(shards, visit); },
                options_.allows_mixed ? store::Environments::several : store::Environments::one,
                options_.may_replace ? store::OtherScenes::replaced : store::OtherScenes::refused);
        });
    }

    /// Visits every configuration of the sweep.
    void show(const std::vector<std::uint32_t>& shards, const store::VisitConfiguration& visit)
    {
        const auto keep_id = [&](const Configuration& configuration) {
            if (options_.keeps_pixels) {
                ids_.emplace(configuration.ordinal, configuration.id);
            }
            visit(configuration);
        };
        for (const Refusal& refusal : sweep_curves_.refusals()) {
            sweep_curves_.describe(refusal, keep_id, options_.unit ? options_.shard.index : 1);
        }
        for (std::size_t i = 0; i < sweep_curves_.requests().size(); ++i) {
            sweep_curves_.describe(i, identities_[i], keep_id, shards[i]);
        }
    }

    /// Waits until the plan and all queued results are recorded.
    void finish_recording()
    {
        recording_.finish();
        outcome_.configurations = planned_.done + planned_.failed + planned_.planned;
        outcome_.retired = planned_.retired;
        if (planned_.has_equal_ids) {
            repeated_ = store_.repeated();
        }
        outcome_.repeated = repeated_.size();
    }

    /// Whether the whole plan will be computed, so that computing need not wait for its recording.
    [[nodiscard]] bool begins_at_once() const
    {
        const bool is_whole = options_.unit.has_value() || options_.shard.count == 1;
        return !has_earlier_results_ && !options_.keeps_pixels && is_whole && refusals_.empty() &&
               !sweep_curves_.may_repeat(identities_);
    }

    [[nodiscard]] store::RunDescription description() const
    {
        store::RunDescription description;
        const raster_gl::GlFacts& facts = context_->facts();
        description.environment = {facts.renderer, facts.version, reference_rt::embree_version(),
                                   GNOMON_VERSION};
        description.shard = options_.shard;
        description.size = space_.size();
        description.axes = space_.distinctions();
        description.lights = space_.lights();
        description.job = options_.job_text;
        description.command = options_.command;
        description.compare_command = options_.compare_command;
        description.notes = notes_;
        return description;
    }

    /// Configurations not computed yet, or computed without requested data: errors at the job's
    /// bias, pixels, verification.
    [[nodiscard]] std::vector<std::uint64_t> missing_ordinals() const
    {
        std::vector<std::uint64_t> missing = store_.ordinals(RunState::planned);
        const auto others = store_.without_job_bias();
        missing.insert(missing.end(), others.begin(), others.end());
        if (options_.verifies) {
            const auto unverified = store_.unverified();
            missing.insert(missing.end(), unverified.begin(), unverified.end());
        }
        if (options_.keeps_pixels) {
            for (const std::uint64_t ordinal : store_.ordinals(RunState::done)) {
                if (!fs::exists(store::pixels_path(options_.folder, ids_.at(ordinal)))) {
                    missing.push_back(ordinal);
                }
            }
        }
        std::sort(missing.begin(), missing.end());
        missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
        return without(missing, repeated_);
    }

    void select_all()
    {
        requests_ = sweep_curves_.requests();
        request_numbers_.resize(requests_.size());
        std::iota(request_numbers_.begin(), request_numbers_.end(), std::size_t{0});
        outcome_.configurations = options_.unit ? options_.unit->ordinals.size() : space_.size();
    }

    /// Keeps only requests and refusals that are still to do.
    void select_missing()
    {
        if (options_.retries_failed) {
            store_.reset_failed();
        }
        const std::vector<std::uint64_t> missing = missing_ordinals();
        for (Refusal& refusal : refusals_) {
            refusal.ordinals = common(missing, refusal.ordinals);
        }
        std::erase_if(refusals_, [](const Refusal& refusal) { return refusal.ordinals.empty(); });
        for (std::size_t i = 0; i < sweep_curves_.requests().size(); ++i) {
            CurveRequest request = sweep_curves_.requests()[i];
            request.ordinals = common(missing, request.ordinals);
            if (!request.ordinals.empty() && !is_refused_[i]) {
                requests_.push_back(std::move(request));
                request_numbers_.push_back(i);
            }
        }
    }

    void compute()
    {
        std::uint64_t total = 0;
        for (const CurveRequest& request : requests_) {
            total += request.ordinals.size();
        }
        for (const Refusal& refusal : refusals_) {
            total += refusal.ordinals.size();
        }
        watcher_.begin(total, outcome_.configurations - total);
        for (const Refusal& refusal : refusals_) {
            store_.record_failure(refusal.ordinals, refusal.message, refusal.retry);
            watcher_.advance(0, refusal.ordinals.size());
        }
        const auto plan = analysis::make_plan(requests_, analysis::camera_slots(requests_));
        FreedMemoryKeeper memory;
        outcome_.counts = analysis::run_sweep(plan, hooks(memory));
        recording_.finish();
        watcher_.end();
        outcome_.is_interrupted = watcher_.should_stop();
    }

    analysis::SweepHooks hooks(FreedMemoryKeeper& memory)
    {
        analysis::SweepHooks hooks;
        hooks.open_scene = [this, &memory](const scene::Job& job) {
            const analysis::OpenScene open = scenes_.open(job);
            memory.keep(largest_need_bytes_);
            return open;
        };
        hooks.task = [this, &memory](std::size_t curve) {
            memory.limit();
            return task(curve);
        };
        hooks.record = [this](analysis::FinishedCurve&& finished) {
            recording_.add([this, finished = std::move(finished)] {
                store_.record(finished);
                watcher_.advance(finished.rows.size(), 0);
            });
        };
        hooks.record_failure = [this](std::span<const std::uint64_t> ordinals,
                                      const std::string& message, analysis::Retry retry) {
            recording_.add(
                [this, message, retry, failed = std::vector(ordinals.begin(), ordinals.end())] {
                    store_.record_failure(failed, message, retry);
                    watcher_.advance(0, failed.size());
                });
        };
        hooks.should_stop = watcher_.should_stop;
        hooks.verifies_biases = options_.verifies;
        hooks.counts_cells = space_.size() <= most_rows_with_cells;
        if (options_.keeps_pixels) {
            hooks.keep_pixels = [this](std::uint64_t ordinal,
                                       const analysis::Comparison& comparison) {
                keep_pixels(options_.folder, ids_.at(ordinal), comparison);
            };
        }
        return hooks;
    }

    analysis::SweepTask task(std::size_t curve)
    {
        const std::size_t number = request_numbers_[curve];
        analysis::SweepTask task = sweep_curves_.task(number, identities_[number]);
        const auto& wanted = requests_[curve].ordinals;
        std::erase_if(task.rows, [&](const analysis::SweepTask::Row& row) {
            return !std::binary_search(wanted.begin(), wanted.end(), row.ordinal);
        });
        watcher_.now(scene::point_text(space_, space_.at(wanted.front()), options_.keeps_pixels));
        return task;
    }

    const scene::SweepSpace& space_;
    const SweepRunOptions& options_;
    const SweepWatcher& watcher_;
    std::unique_ptr<store::RunLock> lock_; ///< null for a unit, whose caller holds it
    SweepCurves sweep_curves_;
    std::vector<Refusal> refusals_;
    std::shared_ptr<const raster_gl::Context> context_;
    SweepScenes scenes_;
    RunStore store_;
    std::optional<tbb::global_control> threads_;
    std::vector<analysis::SceneIdentity> identities_;    ///< by request
    std::vector<bool> is_refused_;                       ///< by request
    std::vector<store::RunNote> notes_;                  ///< about the scenes, in order
    std::uint64_t largest_need_bytes_ = 0;               ///< of any request
    std::unordered_map<std::uint64_t, std::string> ids_; ///< by ordinal; only if pixels are kept
    std::vector<std::uint64_t> repeated_;                ///< ordinals that repeat earlier ones
    std::vector<CurveRequest> requests_;                 ///< still to compute
    std::vector<std::size_t> request_numbers_;           ///< their indices among all requests
    SweepOutcome outcome_;
    bool has_earlier_results_ = false;
    store::PlanOutcome planned_;
    /// Uses the store exclusively until its work is finished; reads the members above.
    analysis::BackgroundWorker recording_{waiting_curves(sweep_curves_.requests())};
};

} // namespace

SweepOutcome sweep(const scene::SweepSpace& space, const SweepRunOptions& options,
                   const SweepWatcher& watcher)
{
    return SweepRun{space, options, watcher}.run();
}

} // namespace gnomon::api
