// The plan of a sweep: which stages it shares.

#include "analysis/sweep/plan.hpp"

#include "analysis/sweep/sweep_curves.hpp"
#include "analysis/sweep/units.hpp"
#include "methods/key_table.hpp"
#include "random_requests.hpp"
#include "scene/job/source.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using Kind = SweepStep::Kind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The plan of a job's text; `keeps` as of `SweepCurves`.
struct Planned {
    std::vector<CurveRequest> requests;
    SweepPlan plan;
    PlanCounts counts;
};

Planned plan_of(const scene::SweepSpace& space)
{
    const SweepCurves sweep_curves{space, false, "1"};
    Planned planned;
    planned.requests = sweep_curves.requests();
    planned.plan = make_plan(planned.requests, camera_slots(planned.requests));
    planned.counts = planned.plan.counts(planned.requests);
    return planned;
}

TEST(SweepPlan, OfTwoHundredThousandConfigurationsSharesAllItCan)
{
    // Two cameras need cases, like anything that sets several keys.
    scene::JobSource source =
        scene::builtin_job_source("columns", {{"light.type", "spot"},
                                              {"light.position", "[0, 12, 0]"},
                                              {"light.target", "[1, 0, 1]"},
                                              {"light.cone_deg", "80"},
                                              {"image.width", "1280"},
                                              {"image.height", "720"}});
    for (const char* const eye : {"[0, 2, 6]", "[3, 2, 6]"}) {
        source.cases.push_back(
            {eye, scene::layer_from_overrides(*source.keys, {{"camera.eye", eye}})});
    }
    const scene::SweepSpace space{source,
                                  {"bias.constant={from=1e-6, to=0.1, count=1000, scale=\"log\"}",
                                   "shadow_map.resolution=256,512,1024,2048,4096",
                                   "shadow_map.depth_format=d16,d24,d32f,u12",
                                   "shadow_map.near=0.1,0.2,0.5,1,2"}};
    ASSERT_EQ(space.size(), 200'000U);
    const Planned planned = plan_of(space);
    EXPECT_EQ(planned.counts, (PlanCounts{.configurations = 200'000,
                                          .scenes = 1,
                                          .truths = 2,
                                          .receiver_passes = 10,
                                          .shadow_maps = 100,
                                          .prefilters = 0,
                                          .lookup_passes = 200,
                                          .curves = 200}));
}

TEST(SweepPlan, OfOneConfigurationRunsEachStageOnce)
{
    const scene::SweepSpace space{scene::builtin_job_source("wall", {}, {}, methods::key_table()),
                                  {}};
    const Planned planned = plan_of(space);
    std::vector<Kind> kinds;
    for (const SweepStep& step : planned.plan.steps) {
        kinds.push_back(step.kind);
    }
    EXPECT_THAT(kinds, ElementsAre(Kind::read_scene, Kind::draw_receivers, Kind::find_truth,
                                   Kind::draw_shadow_map, Kind::look_up, Kind::answer));
    EXPECT_EQ(planned.counts, (PlanCounts{1, 1, 1, 1, 1, 0, 1, 1}));
}

TEST(SweepPlan, AnswersSlopesFromOneLookup)
{
    const scene::SweepSpace space{scene::builtin_job_source("wall", {}, {}, methods::key_table()),
                                  {"bias.slope=0,1,2", "bias.constant=0,0.5"}};
    EXPECT_EQ(plan_of(space).counts, (PlanCounts{6, 1, 1, 1, 1, 0, 1, 3}));
}

TEST(SweepPlan, PrefiltersOnceForEachMapAndWhatIsMadeOfIt)
{
    scene::JobSource source =
        scene::builtin_job_source("wall", {{"method.name", "vsm"}}, {}, methods::key_table());
    for (const char* const eye : {"[0, 2, 6]", "[3, 2, 6]"}) {
        source.cases.push_back(
            {eye, scene::layer_from_overrides(*source.keys, {{"camera.eye", eye}})});
    }
    const scene::SweepSpace space{source,
                                  {"shadow_map.resolution=64,128", "method.kernel=box,gaussian",
                                   "method.bleeding_reduction=0,0.25", "bias.slope=0,1",
                                   "bias.constant=0,0.5,1"}};
    EXPECT_EQ(plan_of(space).counts, (PlanCounts{.configurations = 96,
                                                 .scenes = 1,
                                                 .truths = 2,
                                                 .receiver_passes = 2,
                                                 .shadow_maps = 2,
                                                 .prefilters = 4,
                                                 .lookup_passes = 16,
                                                 .curves = 32}));
}

TEST(SweepPlan, OfTenThousandConfigurationsOfAMethodSharesAllItCan)
{
    const scene::SweepSpace space{
        scene::builtin_job_source("wall", {{"method.name", "vsm"}}, {}, methods::key_table()),
        {"bias.constant={from=1e-6, to=0.1, count=50, scale=\"log\"}",
         "shadow_map.resolution=256,512,1024,2048,4096", "method.kernel=box,gaussian",
         "method.kernel_width=1,3,5,7,9", "method.bleeding_reduction=0,0.1,0.2,0.4"}};
    ASSERT_EQ(space.size(), 10'000U);
    const Planned planned = plan_of(space);
    EXPECT_EQ(planned.counts, (PlanCounts{.configurations = 10'000,
                                          .scenes = 1,
                                          .truths = 1,
                                          .receiver_passes = 1,
                                          .shadow_maps = 5,
                                          .prefilters = 5 * 2 * 5,
                                          .lookup_passes = 5 * 2 * 5 * 4,
                                          .curves = 5 * 2 * 5 * 4}));
    // Exact rays' results are found once for each resolution.
    std::set<std::string> exact;
    for (const CurveRequest& request : planned.requests) {
        exact.insert(request.keys.exact);
    }
    EXPECT_EQ(exact.size(), 5U);
    // No curve of another resolution comes between, so none is found again.
    std::string last;
    std::size_t changes = 0;
    for (const SweepStep& step : planned.plan.steps) {
        const std::string& key = planned.requests[step.curve].keys.exact;
        if (step.kind == Kind::answer && key != last) {
            ++changes;
            last = key;
        }
    }
    EXPECT_EQ(changes, 5U);
}

TEST(SweepPlan, DrawsOneMapForAllMethods)
{
    for (const char* const methods : {"depth,vsm", "vsm,depth"}) {
        const scene::SweepSpace space{
            scene::builtin_job_source("wall", {}, {}, methods::key_table()),
            {fmt::format("method.name={}", methods)}};
        EXPECT_EQ(plan_of(space).counts, (PlanCounts{2, 1, 1, 1, 1, 1, 2, 2})) << methods;
    }
}

TEST(SweepPlan, OfNothingIsEmpty)
{
    const SweepPlan plan = make_plan({}, 2);
    EXPECT_THAT(plan.steps, IsEmpty());
    EXPECT_EQ(plan.counts({}), PlanCounts{});
    EXPECT_EQ(estimate_seconds(plan, {}), 0);
    EXPECT_THAT(divide(plan, {}, 3), IsEmpty());
}

TEST(SweepPlan, NeedsASlot)
{
    EXPECT_THROW((void)make_plan({}, 0), std::invalid_argument);
}

/// Runs the steps on keys in place of results: each stage leaves the keys that made it.
class Interpreter {
public:
    Interpreter(const std::vector<CurveRequest>& requests, std::size_t slots)
        : requests_{requests},
          receivers_(slots),
          truths_(slots)
    {
    }

    void run(const SweepStep& step)
    {
        const StageKeys& keys = requests_.at(step.curve).keys;
        ASSERT_LT(step.slot, receivers_.size());
        switch (step.kind) {
        case Kind::read_scene:
            scene_ = keys.scene;
            std::fill(receivers_.begin(), receivers_.end(), "");
            std::fill(truths_.begin(), truths_.end(), "");
            map_.clear();
            filtered_.clear();
            lookup_.clear();
            break;
        case Kind::draw_receivers:
            EXPECT_EQ(scene_, keys.scene);
            receivers_[step.slot] = keys.receivers;
            break;
        case Kind::find_truth:
            EXPECT_EQ(receivers_[step.slot], keys.receivers);
            truths_[step.slot] = keys.truth;
            break;
        case Kind::draw_shadow_map:
            EXPECT_EQ(scene_, keys.scene);
            map_ = keys.map;
            filtered_.clear();
            break;
        case Kind::prefilter:
            EXPECT_EQ(map_, keys.map);
            filtered_ = keys.filtered;
            break;
        case Kind::look_up:
            EXPECT_EQ(receivers_[step.slot], keys.receivers);
            EXPECT_EQ(truths_[step.slot], keys.truth);
            expect_map(keys);
            lookup_ = keys.lookup;
            break;
        case Kind::answer:
            EXPECT_EQ(scene_, keys.scene);
            EXPECT_EQ(receivers_[step.slot], keys.receivers);
            EXPECT_EQ(truths_[step.slot], keys.truth);
            expect_map(keys);
            EXPECT_EQ(lookup_, keys.lookup);
            ++answers_[step.curve];
            break;
        }
    }
    /// Drops stages that no later step needs.
    void forget(const SweepPlan& plan, std::size_t index)
    {
        if (!plan.needs_map_after(index)) {
            map_ = "forgotten";
            filtered_ = "forgotten";
        }
        if (!plan.needs_truth_after(index)) {
            truths_[plan.steps[index].slot] = "forgotten";
        }
    }
    [[nodiscard]] const std::map<std::size_t, int>& answers() const { return answers_; }

private:
    /// Methods without passes look up the map itself, even after another filtered it.
    void expect_map(const StageKeys& keys) const
    {
        EXPECT_EQ(map_, keys.map);
        if (!keys.filtered.empty()) {
            EXPECT_EQ(filtered_, keys.filtered);
        }
    }

    const std::vector<CurveRequest>& requests_;
    std::string scene_;
    std::vector<std::string> receivers_;
    std::vector<std::string> truths_;
    std::string map_;
    std::string filtered_; ///< keys of the last filtered map
    std::string lookup_;
    std::map<std::size_t, int> answers_;
};

/// One light after the other, as when lights are compared: each has its own truth and map.
TEST(SweepPlan, NeedsNothingOfALightThatIsAnswered)
{
    std::vector<CurveRequest> requests(2);
    for (std::size_t i = 0; i < requests.size(); ++i) {
        StageKeys& keys = requests[i].keys;
        keys.light = keys.truth = keys.frustum = keys.texels = keys.map = keys.lookup =
            std::to_string(i);
        requests[i].ordinals = {i};
    }
    const SweepPlan plan = make_plan(requests, 1);
    ASSERT_EQ(plan.steps.size(), 10U); // the scene and the receivers are shared
    for (const std::size_t answer : {std::size_t{5}, std::size_t{9}}) {
        ASSERT_EQ(plan.steps[answer].kind, Kind::answer);
        EXPECT_FALSE(plan.needs_map_after(answer));
        EXPECT_FALSE(plan.needs_truth_after(answer));
    }
    for (const std::size_t look_up : {std::size_t{4}, std::size_t{8}}) {
        ASSERT_EQ(plan.steps[look_up].kind, Kind::look_up);
        EXPECT_TRUE(plan.needs_map_after(look_up));
        EXPECT_TRUE(plan.needs_truth_after(look_up));
    }
}

TEST(SweepPlan, LeavesBeforeEveryAnswerWhatItNeeds)
{
    std::mt19937 random{21};
    for (int round = 0; round < 400; ++round) {
        const auto requests = random_requests(random);
        const std::size_t slots = 1 + random() % 4;
        SCOPED_TRACE(fmt::format("round {}: {}", round, text_of(requests, slots)));
        const SweepPlan plan = make_plan(requests, slots);
        ASSERT_EQ(plan.slots, slots);
        Interpreter interpreter{requests, slots};
        for (std::size_t i = 0; i < plan.steps.size(); ++i) {
            interpreter.run(plan.steps[i]);
            if (plan.steps[i].kind == Kind::answer) {
                interpreter.forget(plan, i);
            }
        }
        ASSERT_EQ(interpreter.answers().size(), requests.size());
        for (const auto& [request, times] : interpreter.answers()) {
            EXPECT_EQ(times, 1) << "request " << request;
        }
        if (HasFailure()) {
            return;
        }
    }
}

/// The number of different texts of the member among the requests.
std::size_t distinct(const std::vector<CurveRequest>& requests, std::string StageKeys::*member)
{
    std::set<std::string> texts;
    for (const CurveRequest& request : requests) {
        texts.insert(request.keys.*member);
    }
    return texts.size();
}

/// The number of maps that are filtered, by kind.
std::size_t distinct_filtered(const std::vector<CurveRequest>& requests)
{
    const bool leaves_some = std::ranges::any_of(
        requests, [](const CurveRequest& request) { return request.keys.filtered.empty(); });
    return distinct(requests, &StageKeys::filtered) - (leaves_some ? 1 : 0);
}

TEST(SweepPlan, RunsEachStageOnceForEachOfItsKeysWhereCamerasFit)
{
    std::mt19937 random{22};
    for (int round = 0; round < 400; ++round) {
        const auto requests = random_requests(random);
        SCOPED_TRACE(fmt::format("round {}: {}", round, text_of(requests, 5)));
        const PlanCounts counts = make_plan(requests, 5).counts(requests);
        EXPECT_EQ(counts.scenes, distinct(requests, &StageKeys::scene));
        EXPECT_EQ(counts.truths, distinct(requests, &StageKeys::truth));
        EXPECT_EQ(counts.receiver_passes, distinct(requests, &StageKeys::receivers));
        EXPECT_EQ(counts.shadow_maps, distinct(requests, &StageKeys::map));
        EXPECT_EQ(counts.prefilters, distinct_filtered(requests));
        EXPECT_EQ(counts.lookup_passes, distinct(requests, &StageKeys::lookup));
        EXPECT_EQ(counts.curves, requests.size());
    }
}

TEST(SweepPlan, NeverRepeatsATruthWithFewerSlotsThanCameras)
{
    std::mt19937 random{23};
    for (int round = 0; round < 400; ++round) {
        const auto requests = random_requests(random);
        const std::size_t slots = 1 + random() % 4;
        SCOPED_TRACE(fmt::format("round {}: {}", round, text_of(requests, slots)));
        const PlanCounts counts = make_plan(requests, slots).counts(requests);
        EXPECT_EQ(counts.scenes, distinct(requests, &StageKeys::scene));
        EXPECT_EQ(counts.truths, distinct(requests, &StageKeys::truth));
        // Lights come one after the other: receivers that they share may be drawn for each.
        EXPECT_LE(counts.receiver_passes, std::max(distinct(requests, &StageKeys::truth),
                                                   distinct(requests, &StageKeys::receivers)));
        EXPECT_EQ(counts.lookup_passes, distinct(requests, &StageKeys::lookup));
        // One map for each group of `slots` of at most 5 cameras.
        const std::size_t groups = (5 + slots - 1) / slots;
        EXPECT_LE(counts.shadow_maps, groups * distinct(requests, &StageKeys::map));
        EXPECT_LE(counts.prefilters, groups * distinct_filtered(requests));
    }
}

TEST(SweepPlan, CountsItsSteps)
{
    std::mt19937 random{24};
    for (int round = 0; round < 50; ++round) {
        const auto requests = random_requests(random);
        const SweepPlan plan = make_plan(requests, 2);
        std::map<Kind, std::uint64_t> kinds;
        for (const SweepStep& step : plan.steps) {
            ++kinds[step.kind];
        }
        std::uint64_t configurations = 0;
        for (const CurveRequest& request : requests) {
            configurations += request.ordinals.size();
        }
        EXPECT_EQ(plan.counts(requests),
                  (PlanCounts{configurations, kinds[Kind::read_scene], kinds[Kind::find_truth],
                              kinds[Kind::draw_receivers], kinds[Kind::draw_shadow_map],
                              kinds[Kind::prefilter], kinds[Kind::look_up], kinds[Kind::answer]}))
            << text_of(requests, 2);
    }
}

TEST(SweepPlan, DependsOnNothingButItsRequests)
{
    std::mt19937 random{25};
    const auto requests = random_requests(random);
    EXPECT_EQ(make_plan(requests, 2).steps, make_plan(requests, 2).steps);
}

} // namespace
} // namespace gnomon::analysis
