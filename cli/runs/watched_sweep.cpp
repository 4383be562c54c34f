#include "cli/runs/watched_sweep.hpp"

#include "analysis/comparison/comparison.hpp"
#include "api/compare.hpp"
#include "api/sweep/sweep.hpp"
#include "cli/renderer/driven_renderer.hpp"
#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"
#include "reference_rt/truth.hpp"
#include "scene/error.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/load/scene_notes.hpp"
#include "store/run/run_record.hpp"
#include "store/run_folder/pixels.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::cli {
namespace {

using analysis::Configuration;
using analysis::Refusal;
using store::RunState;

constexpr std::string_view own_table = "engine.";
/// After this many failed starts in a row the sweep ends.
constexpr int most_failed_starts = 3;

/// Whether a renderer is sent the key even if the user did not set it.
bool is_always_sent(std::string_view key)
{
    constexpr std::array<std::string_view, 4> tables{"scene.", "camera.", "image.", "light."};
    return key == "shadow_map.resolution" ||
           std::ranges::any_of(tables,
                               [&](std::string_view table) { return key.starts_with(table); });
}

/// Removes parameters that the renderer was not sent: their defaults are Gnomon's, not its own. The
/// engine's keys become columns of this run.
void settle_parameters(Configuration& configuration, const std::vector<std::string>& given)
{
    auto& parameters = configuration.parameters;
    std::ranges::copy_if(
        parameters, std::back_inserter(configuration.light_values),
        [](const auto& parameter) { return parameter.first.starts_with(own_table); });
    std::erase_if(parameters, [&](const auto& parameter) {
        const std::string& key = parameter.first;
        return key.starts_with(own_table) ||
               (!is_always_sent(key) && std::ranges::find(given, key) == given.end());
    });
    configuration.curve = configuration.id; // each configuration is a curve of one bias
    configuration.job_bias.clear();
}

} // namespace

FrameRecorder::FrameRecorder(const scene::SweepSpace& space, const api::SweepRunOptions& options)
    : space_{space},
      options_{options},
      lock_{options.folder},
      curves_{space, true, GNOMON_VERSION},
      store_{options.folder, store::RunStore::Access::write},
      refusals_{curves_.refusals()}
{
}

analysis::SceneIdentity FrameRecorder::identify(DrivenRenderer& renderer, const scene::Job& job)
{
    const scene::SceneFile& file = renderer.load(job);
    store::add_notes(notes_, analysis::scene_name(job.scene),
                     scene::scene_notes(file.scene, {}, {}), 1);
    return analysis::identify_scene(job, scene::content_hash(file.scene), file.defaults);
}

store::RunDescription FrameRecorder::description(const DrivenRenderer& renderer) const
{
    store::RunDescription description;
    description.environment = renderer.environment();
    description.size = space_.size();
    description.axes = space_.distinctions();
    description.job = options_.job_text;
    description.command = options_.command;
    description.compare_command = options_.compare_command;
    description.notes = notes_;
    return description;
}

void FrameRecorder::add(Configuration configuration)
{
    settle_parameters(configuration, given(configuration.ordinal));
    configurations_.push_back(std::move(configuration));
}

void FrameRecorder::plan(DrivenRenderer& renderer)
{
    const auto keep = [this](const Configuration& configuration) { add(configuration); };
    for (const Refusal& refusal : curves_.refusals()) {
        curves_.describe(refusal, keep);
    }
    for (std::size_t i = 0; i < curves_.requests().size(); ++i) {
        analysis::SceneIdentity identity;
        try {
            identity = identify(renderer, curves_.job(i));
        } catch (const scene::InputError& error) {
            refusals_.push_back(
                {curves_.requests()[i].ordinals, error.what(), analysis::Retry::may_help});
        }
        curves_.describe(i, identity, keep);
    }
    if (!refusals_.empty() && refusals_.size() >= configurations_.size()) {
        throw scene::InputError(refusals_.front().message);
    }
    const store::PlanOutcome planned = store_.plan(
        description(renderer), configurations_,
        options_.allows_mixed ? store::Environments::several : store::Environments::one,
        options_.may_replace ? store::OtherScenes::replaced : store::OtherScenes::refused);
    outcome_.retired = planned.retired;
    for (const Refusal& refusal : refusals_) {
        store_.record_failure(refusal.ordinals, refusal.message, refusal.retry);
    }
}

std::vector<std::uint64_t> FrameRecorder::missing()
{
    if (options_.retries_failed) {
        store_.reset_failed();
    }
    std::vector<std::uint64_t> missing = store_.ordinals(RunState::planned);
    if (options_.keeps_pixels) {
        for (const std::uint64_t ordinal : store_.ordinals(RunState::done)) {
            const auto found = std::ranges::find(configurations_, ordinal, &Configuration::ordinal);
            if (!std::filesystem::exists(store::pixels_path(options_.folder, found->id))) {
                missing.push_back(ordinal);
            }
        }
    }
    std::ranges::sort(missing);
    const auto repeated = store_.repeated();
    outcome_.repeated = repeated.size();
    return api::without(missing, repeated);
}

scene::Job FrameRecorder::job(std::uint64_t ordinal) const
{
    return space_.job(space_.at(ordinal));
}

std::vector<std::string> FrameRecorder::given(std::uint64_t ordinal) const
{
    return key_names(space_.given_keys(space_.at(ordinal)));
}

void FrameRecorder::record(std::uint64_t ordinal, const analysis::Comparison& comparison)
{
    const auto found = std::ranges::find(configurations_, ordinal, &Configuration::ordinal);
    if (options_.keeps_pixels) {
        api::keep_pixels(options_.folder, found->id, comparison);
    }
    store_.record(analysis::finish_compared(comparison, found->curve, ordinal));
    ++outcome_.counts.configurations;
}

void FrameRecorder::record_failure(std::uint64_t ordinal, const std::string& message,
                                   analysis::Retry retry)
{
    store_.record_failure(std::array{ordinal}, message, retry);
    ++outcome_.counts.configurations;
}

api::SweepOutcome FrameRecorder::finish()
{
    store_.write_csv();
    const store::PlanOutcome counts = store_.outcome();
    outcome_.configurations = counts.done + counts.failed + counts.planned;
    outcome_.done = counts.done;
    outcome_.failed = counts.failed;
    outcome_.retriable = counts.failed > 0 ? store_.retriable() : 0;
    outcome_.checks = store_.checks();
    return outcome_;
}

namespace {

/// Draws and records one configuration; true if the renderer ended.
bool sweep_one(FrameRecorder& run, DrivenRenderer& renderer, std::uint64_t ordinal,
               Progress& progress)
{
    try {
        run.record(ordinal, renderer.compare(run.job(ordinal), run.given(ordinal)));
        progress.add(1, 0);
        return false;
    } catch (const RendererFailure& error) {
        run.record_failure(ordinal, error.what(), analysis::Retry::may_help);
        progress.add(0, 1);
        return true;
    } catch (const scene::InputError& error) {
        run.record_failure(ordinal, error.what(), analysis::Retry::is_useless);
        progress.add(0, 1);
        return false;
    }
}

} // namespace

api::SweepOutcome sweep_renderer(const scene::SweepSpace& space,
                                 const api::SweepRunOptions& options, DrivenRenderer& renderer,
                                 bool is_quiet)
{
    FrameRecorder run{space, options};
    run.plan(renderer);
    const auto missing = run.missing();
    stop_on_signals();
    {
        Progress progress{missing.size(), space.size() - missing.size(), is_quiet};
        int failed_starts = 0;
        for (const std::uint64_t ordinal : missing) {
            if (is_interrupted() || failed_starts >= most_failed_starts) {
                break;
            }
            progress.begin(scene::point_text(space, space.at(ordinal), true));
            const bool has_ended = sweep_one(run, renderer, ordinal, progress);
            failed_starts = has_ended && renderer.failed_to_start() ? failed_starts + 1 : 0;
        }
    }
    renderer.close();
    api::SweepOutcome outcome = run.finish();
    outcome.is_interrupted = is_interrupted();
    return outcome;
}

api::SweepOutcome watched_sweep(const scene::SweepSpace& space, const api::SweepRunOptions& options,
                                bool is_quiet)
{
    std::unique_ptr<Progress> progress;
    api::SweepWatcher watcher;
    watcher.begin = [&](std::uint64_t total, std::uint64_t known) {
        progress = std::make_unique<Progress>(total, known, is_quiet);
        stop_on_signals();
    };
    watcher.now = [&](const std::string& configuration) { progress->begin(configuration); };
    watcher.advance = [&](std::uint64_t done, std::uint64_t failed) {
        progress->add(done, failed);
    };
    watcher.end = [&] { progress.reset(); };
    watcher.should_stop = [] { return is_interrupted(); };
    return api::sweep(space, options, watcher);
}

} // namespace gnomon::cli
