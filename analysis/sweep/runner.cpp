#include "analysis/sweep/runner.hpp"

#include "analysis/comparison/finished_curve.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/stopwatch.hpp"
#include "analysis/sweep/background_worker.hpp"
#include "analysis/sweep/lookup_stage.hpp"
#include "analysis/sweep/stage_result.hpp"
#include "analysis/sweep/task_question.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"

#include <algorithm>
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

/// Hands finished and failed configurations on, one at a time.
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
        // What one camera's lookups say is kept for the next: their curves are answered in turn.
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
    /// Lookups that wait for their answers or get them: they bound the memory.
    static constexpr std::size_t most_lookups = 2;

    /// Cameras that the plan keeps side by side.
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
    /// The task's job, with what its scene decides, without constant bias: an invalid bias fails
    /// its own row, not the stages. What one is multiplied with in each map stays: it is the same
    /// of all rows.
    [[nodiscard]] scene::Job stage_job() const
    {
        scene::Job job = scene::with_layout(task_.job, require_result(scene_)->open.file->defaults);
        scene::set_constant(job, *unit_, 0, 0);
        return job;
    }
    /// The view of a stage that comes before the lookup: what only that refuses is no matter here,
    /// for other tasks share the stage.
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
        finish_lanes(); // what they work on refers to the scene before
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
        scene_.retry = Retry::may_help; // a file may be mended
    }

    void draw_receivers(std::size_t slot)
    {
        ++counts_.receiver_passes;
        receivers_[slot] = {}; // before others take memory
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
        lookup_ = {}; // it may hold the map, which goes before the next one takes memory
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

    /// What lookups of the task's job read.
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

    /// Lets go of the lookup before if it holds the depths of a large map: one of those at a time.
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
            return; // each bias by itself, when it is answered
        }
        make_room_for_depths();
        lookup_ = run_stage<LookupStage>([&] {
            const renderers::Drawn drawn = this->drawn(slot);
            auto subject = require_result(subjects_[slot]);
            // The subject lives as long as its part is used.
            std::shared_ptr<ScoredReceivers> judged{subject, &subject->judged};
            return std::make_shared<LookupStage>(*require_result(scene_), std::move(judged), slot,
                                                 caches_, look_up_for_every_bias(drawn));
        });
    }

    /// The lookup where the job's biases move it; no other bias matters to its answers.
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

    /// Whether every bias is looked up and compared by itself.
    [[nodiscard]] bool is_compared() const
    {
        return hooks_.keep_pixels || !methods::traits(task_.job).has_curve();
    }

    /// Whether GL is asked again for what a curve says, or to verify it.
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
            finish_lanes(); // GL is asked by this thread alone
            answer_by_curve(task_, lookup_, slot);
            return task_curve_.reset();
        }
        lanes_[slot % lanes_.size()]->add(
            [this, task = std::move(task_), lookup = lookup_, slot]() mutable {
                answer_by_curve(task, lookup, slot);
            });
        task_curve_.reset();
    }

    /// Called by a lane, or where GL verifies by its own thread. Only the work is a stage: what the
    /// hooks throw ends the sweep.
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

    /// Holds the curve to GL's reruns. Source: docs/bias_curve.md#verification.
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
        hand_over(slot, comparison);
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

    /// Gives the comparison the receivers and the truth, and lets go of what no later step needs.
    void hand_over(std::size_t slot, Comparison& comparison)
    {
        const auto subject = require_result(subjects_[slot]);
        // Where pixels are kept, no lane reads the subject; elsewhere one still may.
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

    /// What a curve's answer depends on, beside the lookup: its id, the camera's slot, whether it
    /// recommends a bias in metres, and the job's own bias, of which it has errors by distance.
    using CurveName = std::tuple<std::string, std::size_t, const scene::BiasUnit*, float>;

    /// Of a curve that GL was asked for, which takes long.
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
    std::size_t index_ = 0;                 ///< of the step
    SweepTask task_;                        ///< of the step
    StageSeconds seconds_;                  ///< of the task's steps
    std::optional<scene::View> stage_view_; ///< of the task; found when first asked for
    const scene::BiasUnit* unit_ = &scene::bias_in_depth; ///< of its rows' constant biases
    std::optional<std::size_t> task_curve_; ///< whose task it is; empty: it was handed over
    StageResult<ReadScene> scene_;
    std::vector<StageResult<const renderers::Receivers>> receivers_; ///< by slot
    std::vector<StageResult<SweepSubject>> subjects_;                ///< by slot
    StageResult<const renderers::ShadowMap> map_;
    StageResult<const renderers::FilteredMap> filtered_; ///< of the map; fails where it does
    LightQueryCaches caches_;                            ///< the lanes'
    StageResult<LookupStage> lookup_;
    /// The curve of the comparison before; empty where it is found at once.
    std::optional<std::pair<CurveName, KnownCurve>> known_;
    std::string verified_; ///< the curve that was verified last, of those compared bias by bias
    std::vector<std::unique_ptr<BackgroundWorker>> lanes_; ///< last: they work on the others
};

} // namespace

PlanCounts run_sweep(const SweepPlan& plan, const SweepHooks& hooks)
{
    return Runner{plan, hooks}.run();
}

} // namespace gnomon::analysis
