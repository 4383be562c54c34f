#include "analysis/sweep/runner.hpp"

#include "analysis/comparison/comparison.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/stopwatch.hpp"
#include "analysis/sweep/background_worker.hpp"
#include "analysis/sweep/sweep_stages.hpp"
#include "analysis/sweep/sweep_task.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

using Kind = SweepStep::Kind;

/// Passes finished and failed configurations to the hooks, one at a time.
class ResultSink {
public:
    explicit ResultSink(const SweepHooks& hooks) : hooks_{hooks} {}

    void finished(FinishedCurve&& curve)
    {
        const std::lock_guard lock{mutex_};
        hooks_.record(std::move(curve));
    }
    void failed(const std::vector<std::uint64_t>& ordinals, const std::string& message, Retry retry)
    {
        const std::lock_guard lock{mutex_};
        hooks_.record_failure(ordinals, message, retry);
    }

private:
    const SweepHooks& hooks_;
    std::mutex mutex_;
};

class Runner {
public:
    Runner(const SweepPlan& plan, const SweepHooks& hooks)
        : plan_{plan},
          hooks_{hooks},
          receivers_(plan.slots),
          subjects_(plan.slots),
          caches_(plan.slots)
    {
        // Each camera keeps its answers for its next lookup, so one thread answers its curves in
        // turn.
        const std::size_t lanes = std::min<std::size_t>(cameras(plan), most_lookups);
        for (std::size_t i = 0; i < lanes; ++i) {
            lanes_.push_back(std::make_unique<BackgroundWorker>(most_lookups / lanes));
        }
    }

    PlanCounts run()
    {
        for (index_ = 0; index_ < plan_.steps.size() && !hooks_.should_stop(); ++index_) {
            do_step(plan_.steps[index_]);
        }
        finish_lanes();
        return counts_;
    }

private:
    /// Lookups that wait for answers or get them; bounds the memory.
    static constexpr std::size_t most_lookups = 2;

    /// Cameras that the plan holds at once.
    static std::size_t cameras(const SweepPlan& plan)
    {
        std::size_t cameras = 1;
        for (const SweepStep& step : plan.steps) {
            cameras = std::max(cameras, step.slot + 1);
        }
        return cameras;
    }
    void finish_lanes()
    {
        for (const auto& lane : lanes_) {
            lane->finish();
        }
    }

    void do_step(const SweepStep& step)
    {
        if (task_curve_ != step.curve) {
            task_ = hooks_.task(step.curve);
            unit_ = task_.rows.empty() ? &scene::bias_in_depth
                                       : &scene::bias_unit_of(task_.rows.front().bias);
            task_curve_ = step.curve;
            stage_view_.reset();
            seconds_ = {};
        }
        switch (step.kind) {
        case Kind::read_scene:
            return timed(seconds_.scene, [&] { read_scene(); });
        case Kind::draw_receivers:
            return timed(seconds_.receivers, [&] { draw_receivers(step.slot); });
        case Kind::find_truth:
            return timed(seconds_.truth, [&] { find_truth(step.slot); });
        case Kind::draw_shadow_map:
            return timed(seconds_.shadow_map, [&] { draw_shadow_map(); });
        case Kind::prefilter:
            return timed(seconds_.shadow_map, [&] { prefilter(); });
        case Kind::look_up:
            return look_up(step.slot);
        case Kind::answer:
            return answer(step.slot);
        }
    }

    [[nodiscard]] scene::View view_of(const scene::Job& job) const
    {
        const scene::SceneFile& file = *require_result(scene_)->open.file;
        return scene::resolve_view(job, file.scene, file.defaults);
    }
    /// The task's job with its scene's defaults, without constant bias: an invalid bias fails its
    /// own row, not the stages. The factor of a bias in each map stays: all rows share it.
    [[nodiscard]] scene::Job stage_job() const
    {
        scene::Job job = scene::with_layout(task_.job, require_result(scene_)->open.file->defaults);
        scene::set_constant(job, *unit_, 0, 0);
        return job;
    }
    /// The view of a stage before the lookup. It ignores keys that only the lookup may refuse,
    /// because other tasks share the stage.
    [[nodiscard]] const scene::View& stage_view()
    {
        if (!stage_view_) {
            scene::Job job = stage_job();
            job.lookup.position.reset();
            stage_view_ = view_of(job);
        }
        return *stage_view_;
    }
    [[nodiscard]] const Renderers& renderers() const
    {
        return *require_result(scene_)->open.renderers;
    }
    [[nodiscard]] renderers::Rasterizer& rasterizer() const { return renderers().rasterizer; }

    void read_scene()
    {
        finish_lanes(); // they refer to the previous scene
        lookup_ = {};
        caches_ = LightQueryCaches{plan_.slots};
        filtered_ = {};
        map_ = {};
        receivers_.assign(plan_.slots, {});
        subjects_.assign(plan_.slots, {});
        stage_view_.reset();
        ++counts_.scenes;
        scene_ = run_stage<ReadScene>([&] {
            const OpenScene open = hooks_.open_scene(task_.job);
            return std::make_shared<ReadScene>(
                ReadScene{open, summarise_scene(task_.job.scene, open.file->scene)});
        });
        scene_.retry = Retry::may_help; // the file may be corrected
    }

    void draw_receivers(std::size_t slot)
    {
        ++counts_.receiver_passes;
        receivers_[slot] = {}; // frees memory for others
        receivers_[slot] = run_stage<const renderers::Receivers>(
            [&] { return rasterizer().draw_receivers(stage_view()); });
    }

    void find_truth(std::size_t slot)
    {
        ++counts_.truths;
        subjects_[slot] = run_stage<SweepSubject>([&] {
            const auto receivers = require_result(receivers_[slot]);
            scene::ReceiverLayers layers = receivers->layers();
            scene::Truth truth =
                renderers().reference.find_truth(stage_view(), layers, receivers->raster_facts());
            return std::make_shared<SweepSubject>(
                std::move(layers), std::move(truth),
                ReceiverUse{.by_many_maps = true, .counts_cells = hooks_.counts_cells});
        });
    }

    void draw_shadow_map()
    {
        ++counts_.shadow_maps;
        make_room_for_depths();
        lookup_ = {}; // it may hold the map; frees memory for the next one
        filtered_ = {};
        map_ = {};
        map_ = run_stage<const renderers::ShadowMap>(
            [&] { return rasterizer().draw_map(stage_job(), stage_view(), {}); });
    }

    void prefilter()
    {
        ++counts_.prefilters;
        filtered_ = {};
        filtered_ = run_stage<const renderers::FilteredMap>([&] {
            methods::check(stage_job());
            return filter_map();
        });
    }

    [[nodiscard]] std::shared_ptr<const renderers::FilteredMap> filter_map()
    {
        return rasterizer().filter_map(require_result(map_), stage_job(), stage_view(),
                                       renderers::FilteredContent::of_method);
    }

    /// The map that lookups of the task's job read.
    [[nodiscard]] std::shared_ptr<const renderers::FilteredMap> map_of_task()
    {
        if (!methods::traits(task_.job).has_map) {
            return renderers::draw_filtered_map(rasterizer(), stage_job(), stage_view());
        }
        return methods::passes(task_.job).prefilter.empty() ? filter_map()
                                                            : require_result(filtered_);
    }
    [[nodiscard]] renderers::Drawn drawn(std::size_t slot)
    {
        auto map = map_of_task();
        return {require_result(receivers_[slot]), std::move(map)};
    }

    /// Drops the previous lookup if it holds the depths of a large map: memory has room for one.
    void make_room_for_depths()
    {
        constexpr std::size_t most_texels = 4096 * 4096;
        const auto side = static_cast<std::size_t>(task_.job.shadow_map.resolution_texels);
        if (!methods::traits(task_.job).has_one_tap() &&
            scene::map_count(stage_job()) * side * side > most_texels) {
            lookup_ = {};
            finish_lanes();
        }
    }

    void look_up(std::size_t slot)
    {
        ++counts_.lookup_passes;
        if (is_compared()) {
            return; // each bias separately, for its answer
        }
        make_room_for_depths();
        lookup_ = run_stage<LookupStage>([&] {
            const renderers::Drawn drawn = this->drawn(slot);
            auto subject = require_result(subjects_[slot]);
            // Shares ownership of the subject.
            std::shared_ptr<ScoredReceivers> scored{subject, &subject->scored};
            return std::make_shared<LookupStage>(*require_result(scene_), std::move(scored), slot,
                                                 caches_, look_up_for_every_bias(drawn));
        });
    }

    /// Looks up where the job's biases move the lookup; its answers depend on no other bias.
    ObservedLookup look_up_for_every_bias(const renderers::Drawn& drawn)
    {
        const scene::Job job = stage_job();
        methods::check(job);
        const scene::View view = view_of(job);
        return observe_lookup(
            job, view, require_result(scene_)->open.file->scene,
            rasterizer().look_up({drawn, job, view}), [drawn = drawn] { return drawn; },
            rasterizer());
    }

    /// Whether every bias is looked up and compared separately.
    [[nodiscard]] bool is_compared() const
    {
        return hooks_.keep_pixels || !methods::traits(task_.job).has_curve();
    }

    /// Whether the curve or its verification needs GL again.
    [[nodiscard]] bool asks_gl() const
    {
        return hooks_.verifies_biases || !methods::traits(task_.job).has_formula();
    }

    void answer(std::size_t slot)
    {
        ++counts_.curves;
        counts_.configurations += task_.rows.size();
        if (is_compared()) {
            return answer_by_comparison(slot, task_.rows.at(0));
        }
        if (asks_gl()) {
            finish_lanes(); // only this thread calls GL
            answer_by_curve(task_, lookup_, slot);
            return task_curve_.reset();
        }
        lanes_[slot % lanes_.size()]->add(
            [this, task = std::move(task_), lookup = lookup_, slot]() mutable {
                answer_by_curve(task, lookup, slot);
            });
        task_curve_.reset();
    }

    /// Called by a lane, or by the GL thread for verification. Only the work is a stage: exceptions
    /// of the hooks end the sweep.
    void answer_by_curve(SweepTask& task, const StageResult<LookupStage>& lookup, std::size_t slot)
    {
        std::vector<RefusedRow> refused;
        const auto made = run_stage<std::optional<FinishedCurve>>([&] {
            const auto work = require_result(lookup);
            const CurveQuestion question = question_of(task, work->frustum(), refused);
            auto finished = std::make_shared<std::optional<FinishedCurve>>();
            if (!question.rows.empty()) {
                *finished = work->answer(question);
                if (hooks_.verifies_biases) {
                    verify(*work, question, slot, (*finished)->curve);
                }
            }
            return finished;
        });
        for (const RefusedRow& row : refused) {
            sink_.failed({row.ordinal}, row.message, Retry::is_useless);
        }
        if (!made.value) {
            sink_.failed(ordinals_of(task), made.error, made.retry);
        } else if (auto& finished = *made.value) {
            sink_.finished(std::move(*finished));
        }
    }

    /// Compares the curve with GL's reruns. Source: docs/bias_curve.md#verification.
    void verify(LookupStage& work, const CurveQuestion& question, std::size_t slot,
                CurveResult& curve)
    {
        const scene::Image<float> criticals = work.critical_biases(question.slope);
        const auto& triangles = require_result(subjects_[slot])->receivers.triangle;
        const renderers::Drawn drawn = this->drawn(slot);
        const scene::Job job = stage_job();
        scene::View biased = stage_view();
        add_reruns(
            curve.verification,
            verify_biases(triangles, criticals,
                          biases_to_verify(criticals, triangles, wanted_biases(question, curve)),
                          [&](float constant) {
                              biased.bias.constant = constant;
                              return rasterizer().look_up({drawn, job, biased});
                          }));
    }

    void answer_by_comparison(std::size_t slot, const SweepTask::Row& row)
    {
        const auto made = run_stage<Comparison>(
            [&] { return std::make_shared<Comparison>(compare_row(slot, row)); });
        if (!made.value) {
            return sink_.failed({row.ordinal}, made.error, made.retry);
        }
        std::optional<FinishedCurve> finished;
        if (hooks_.record) {
            finished = finish_row(slot, row, *made.value);
        }
        if (hooks_.keep_pixels) {
            hooks_.keep_pixels(row.ordinal, std::move(*made.value));
        }
        if (finished) {
            sink_.finished(std::move(*finished));
        }
    }

    FinishedCurve finish_row(std::size_t slot, const SweepTask::Row& row,
                             const Comparison& comparison)
    {
        FinishedCurve finished = finish_compared(comparison, task_.id, row.ordinal);
        if (comparison.held && comparison.held->differences > 0) {
            add_reruns(finished.curve.verification, {{*comparison.held}});
        }
        if (hooks_.verifies_biases && verified_ != task_.id) {
            if (auto verification = verify_comparison(comparison, drawn(slot), renderers())) {
                add_reruns(finished.curve.verification, std::move(*verification));
            }
            verified_ = task_.id;
        }
        return finished;
    }

    Comparison compare_row(std::size_t slot, const SweepTask::Row& row)
    {
        const auto scene = require_result(scene_);
        scene::Job job = task_.job;
        job.bias = row.bias;
        double begin_s = 0;
        Comparison comparison = timed(begin_s, [&] {
            return begin_comparison(job, *scene->open.file, scene->summary, renderers());
        });
        comparison.seconds = seconds_;
        comparison.seconds.scene += begin_s;
        StageSeconds& seconds = comparison.seconds;
        renderers::Drawn drawn = timed(seconds.shadow_map, [&] { return this->drawn(slot); });
        comparison.lookup = timed(seconds.lookup, [&] {
            return rasterizer().look_up({drawn, comparison.job, comparison.view});
        });
        share_subject(slot, comparison);
        const float own_bias = own_constant_bias(task_.job, comparison.view.first_map());
        const CurveName name{task_.id, slot, &scene::bias_unit_of(row.bias), own_bias};
        const KnownCurve* const known = known_ && known_->first == name ? &known_->second : nullptr;
        timed(seconds.analysis, [&] {
            const auto measure = hooks_.keep_pixels ? measure_fully : measure_comparison;
            measure(comparison, std::move(drawn), renderers(), {own_bias, known});
        });
        if (known == nullptr && hooks_.record) {
            remember_curve(name, comparison);
        }
        return comparison;
    }

    /// Gives the comparison its receivers and truth, and frees stages that no later step needs.
    void share_subject(std::size_t slot, Comparison& comparison)
    {
        const auto subject = require_result(subjects_[slot]);
        // If pixels are kept, no lane reads the subject; else one still may.
        if (hooks_.keep_pixels && !plan_.needs_truth_after(index_)) {
            comparison.receivers = std::move(subject->receivers);
            comparison.truth = std::move(subject->truth);
            subjects_[slot] = {};
        } else {
            comparison.receivers = subject->receivers;
            comparison.truth = subject->truth;
        }
        if (!plan_.needs_map_after(index_) && !hooks_.verifies_biases) {
            filtered_ = {};
            map_ = {};
        }
    }

    /// What a curve's answer depends on besides the lookup: its id, the camera's slot, the unit of
    /// its recommended bias, and the job's own bias, at which it has errors by distance.
    using CurveName = std::tuple<std::string, std::size_t, const scene::BiasUnit*, float>;

    /// Keeps a curve that took GL long to find.
    void remember_curve(const CurveName& name, const Comparison& comparison)
    {
        if (comparison.diagnosis && comparison.diagnosis->biases &&
            !methods::traits(task_.job).has_formula()) {
            known_.emplace(name,
                           KnownCurve{comparison.diagnosis->curve, *comparison.diagnosis->biases,
                                      comparison.diagnosis->left_by_recommended});
        }
    }

    const SweepPlan& plan_;
    const SweepHooks& hooks_;
    ResultSink sink_{hooks_};
    PlanCounts counts_;
    std::size_t index_ = 0;                               ///< of the step
    SweepTask task_;                                      ///< of the step
    StageSeconds seconds_;                                ///< of the task's steps
    std::optional<scene::View> stage_view_;               ///< of the task; resolved on first use
    const scene::BiasUnit* unit_ = &scene::bias_in_depth; ///< of the rows' constant biases
    std::optional<std::size_t> task_curve_; ///< of `task_`; empty once that was handed over
    StageResult<ReadScene> scene_;
    std::vector<StageResult<const renderers::Receivers>> receivers_; ///< by slot
    std::vector<StageResult<SweepSubject>> subjects_;                ///< by slot
    StageResult<const renderers::ShadowMap> map_;
    StageResult<const renderers::FilteredMap> filtered_; ///< of the map; fails if the map does
    LightQueryCaches caches_;                            ///< the lanes'
    StageResult<LookupStage> lookup_;
    /// The previous comparison's curve; empty for curves that take no time.
    std::optional<std::pair<CurveName, KnownCurve>> known_;
    std::string verified_;                                 ///< the last curve verified bias by bias
    std::vector<std::unique_ptr<BackgroundWorker>> lanes_; ///< last: threads use the others
};

} // namespace

PlanCounts run_sweep(const SweepPlan& plan, const SweepHooks& hooks)
{
    return Runner{plan, hooks}.run();
}

} // namespace gnomon::analysis
