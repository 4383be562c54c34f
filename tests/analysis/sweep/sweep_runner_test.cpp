// Runs a plan with renderers that need neither GL nor Embree.

#include "analysis/sweep/runner.hpp"

#include "fake_sweep.hpp"
#include "lane.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {
namespace {

using ::testing::IsEmpty;

TEST(SweepRunner, RunsEachStageAsOftenAsPlanned)
{
    FakeSweep sweep{{"shadow_map.near=-2,-1", "shadow_map.resolution=4,8", "bias.slope=0,0.25",
                     "bias.constant=0,0.125,0.25"},
                    {},
                    two_cameras()};
    const PlanCounts counts = sweep.run();
    EXPECT_EQ(counts, (PlanCounts{48, 1, 2, 4, 4, 0, 8, 16}));
    EXPECT_EQ(counts, sweep.planned);
    EXPECT_EQ(sweep.calls("truth"), 2U);
    EXPECT_EQ(sweep.calls("receivers"), 4U);
    EXPECT_EQ(sweep.calls("map"), 4U);
    EXPECT_EQ(sweep.calls("lookup"), 8U);
    EXPECT_THAT(sweep.failed, IsEmpty());
    expect_compared(sweep);
}

TEST(SweepRunner, DrawsReceiversOnceForAllLightMatricesWhereThePixelPlacesThem)
{
    FakeSweep sweep{{"shadow_map.near=-2,-1", "shadow_map.resolution=4,8", "bias.slope=0,0.25",
                     "bias.constant=0,0.125,0.25"},
                    {{"lookup.position", "pixel"}},
                    two_cameras()};
    const PlanCounts counts = sweep.run();
    EXPECT_EQ(counts, (PlanCounts{48, 1, 2, 2, 4, 0, 8, 16}));
    EXPECT_EQ(sweep.calls("receivers"), 2U);
    EXPECT_THAT(sweep.failed, IsEmpty());
    expect_compared(sweep);
}

TEST(SweepRunner, GivesWhatAComparisonGives)
{
    const bool is_full = tests::runs_full_tests();
    struct Part {
        std::string reversed, filters, outside, normals, constants;
    };
    // The usual lane tries each filter one way round, and each policy with one pair of filters.
    for (const Part& part : {Part{"false", "nearest,hardware", "lit,clamp", "0", "0.0625,-0.125"},
                             Part{"true", "linear,pcf3", "shadowed", "1", "0,0.3"}}) {
        const std::string filters = is_full ? "nearest,linear,pcf3,hardware" : part.filters;
        FakeSweep sweep{{"lookup.filter=" + filters,
                         "lookup.outside=" + (is_full ? "lit,shadowed,clamp" : part.outside),
                         "bias.normal_texels=" + (is_full ? "0,1" : part.normals),
                         is_full ? "bias.slope=0,0.0625" : "bias.slope=0.0625",
                         "bias.constant=" + (is_full ? "0.0625,-0.125,0,0.3" : part.constants)},
                        {{"shadow_map.reversed", part.reversed}, {"shadow_map.resolution", "5"}}};
        EXPECT_EQ(sweep.run(), sweep.planned);
        EXPECT_THAT(sweep.failed, IsEmpty());
        expect_compared(sweep);
    }
}

TEST(SweepRunner, CountsCellsOnlyWhereTheyAreWanted)
{
    for (const bool is_wanted : {true, false}) {
        FakeSweep sweep{{"bias.constant=0.0625,0"}, {}};
        sweep.hooks.counts_cells = is_wanted;
        sweep.hooks.record = [&](const FinishedCurve& finished) {
            ASSERT_EQ(finished.rows.size(), 2U);
            for (const FinishedCurve::Row& row : finished.rows) {
                EXPECT_EQ(row.result.cells.empty(), !is_wanted);
                EXPECT_GT(row.result.metrics.pixels.total, 0U);
            }
        };
        EXPECT_EQ(sweep.run(), sweep.planned);
    }
}

TEST(SweepRunner, GivesTheSameRowsWhenItKeepsPixels)
{
    const std::vector<std::string> axes{
        "lookup.filter=nearest,pcf3,hardware",
        tests::in_lane("bias.normal_texels=1", "bias.normal_texels=0,1"),
        tests::in_lane("bias.slope=0.0625", "bias.slope=0,0.0625"), "bias.constant=0,0.125"};
    FakeSweep curves{axes, {{"shadow_map.resolution", "5"}}, two_cameras()};
    FakeSweep pixels{axes, {{"shadow_map.resolution", "5"}}, two_cameras()};
    pixels.keep_pixels();
    curves.run();
    EXPECT_EQ(pixels.run(), pixels.planned);
    EXPECT_EQ(curves.done, pixels.done);
    EXPECT_THAT(curves.kept, IsEmpty());
    std::sort(pixels.kept.begin(), pixels.kept.end());
    ASSERT_EQ(pixels.kept.size(), pixels.space.size());
    for (std::size_t i = 0; i < pixels.kept.size(); ++i) {
        EXPECT_EQ(pixels.kept[i], i);
    }
    ASSERT_EQ(curves.curves.size(), pixels.curves.size());
    for (const auto& [id, curve] : curves.curves) {
        const CurveResult& other = pixels.curves.at(id);
        EXPECT_EQ(curve.near_m, other.near_m);
        EXPECT_EQ(curve.far_m, other.far_m);
        EXPECT_EQ(curve.map_bytes, other.map_bytes);
        ASSERT_EQ(curve.best.has_value(), other.best.has_value());
        EXPECT_EQ(curve.points, other.points);
        ASSERT_EQ(curve.by_distance.size(), other.by_distance.size());
        for (std::size_t i = 0; i < curve.by_distance.size(); ++i) {
            EXPECT_EQ(curve.by_distance[i].at, other.by_distance[i].at);
            EXPECT_EQ(curve.by_distance[i].bias, other.by_distance[i].bias);
            EXPECT_EQ(text_of(curve.by_distance[i].bins), text_of(other.by_distance[i].bins));
        }
    }
}

TEST(SweepRunner, DescribesTheCurveAtTheJobsOwnBias)
{
    FakeSweep sweep{{"bias.slope=0,0.0625"}, {{"bias.constant", "0.125"}}};
    sweep.run();
    FakeSweep biases{{"bias.slope=0,0.0625", "bias.constant=0,0.5"}};
    biases.run();
    for (std::uint64_t i = 0; i < 2; ++i) {
        const Comparison own = sweep.compared(i);
        const BiasAnswers& answers = *own.diagnosis->biases;
        const SweepCurves sweep_curves{sweep.space, false, "1.0"};
        const CurveResult& curve = sweep.curves.at(sweep_curves.task(i, {"hash", ""}).id);
        ASSERT_EQ(curve.by_distance.size(), 2U);
        EXPECT_EQ(curve.by_distance[0].at, DistanceProfile::At::job_bias);
        EXPECT_EQ(curve.by_distance[0].bias, 0.125F);
        EXPECT_EQ(text_of(curve.by_distance[0].bins), text_of(own.diagnosis->by_distance));
        EXPECT_EQ(curve.by_distance[1].bias, answers.best.recommended());
        EXPECT_EQ(curve.best->interval.lo, answers.best.interval.lo);
        EXPECT_EQ(curve.best->interval.hi, answers.best.interval.hi);
        EXPECT_EQ(curve.best->errors.total(), answers.best.errors.total());
        EXPECT_EQ(curve.bounds->strict.acne_free, answers.bounds.strict.acne_free);
        EXPECT_EQ(curve.bounds->strict.panning_free, answers.bounds.strict.panning_free);
        EXPECT_EQ(curve.near_m, own.view.first_map().near_m);
        // A job without a bias has none, whatever its axis sets.
        EXPECT_EQ(biases.curves.at(curve.id).by_distance[0].bias, 0.0F);
    }
}

TEST(SweepRunner, SamplesTheAmountsOfACurveByBisection)
{
    FakeSweep sweep{{"bias.constant=0,0.125"}, {{"lookup.filter", "hardware"}}};
    sweep.run();
    ASSERT_EQ(sweep.curves.size(), 1U);
    const CurveResult& curve = sweep.curves.begin()->second;
    EXPECT_TRUE(curve.best.has_value());
    EXPECT_TRUE(curve.bounds.has_value());
    EXPECT_TRUE(curve.amounts_are_sampled);
    EXPECT_GE(curve.points.size(), 26U);
    // Samples of the ladder, and windows of 64 biases around the least, which move up to four
    // times.
    EXPECT_LE(curve.points.size(), 27U + 5 * 64U);
    EXPECT_EQ(curve.by_distance.size(), 2U);
    EXPECT_EQ(sweep.done.size(), 2U);
    expect_compared(sweep);
}

TEST(SweepRunner, KeepsTheErrorsByDistanceOfEachCasesOwnBias)
{
    const std::vector<scene::CaseLayer> cases{case_of("small", {{"bias.constant", "0.125"}}),
                                              case_of("large", {{"bias.constant", "0.25"}})};
    for (const bool keeps_pixels : {false, true}) {
        FakeSweep sweep{{}, {{"lookup.filter", "hardware"}}, cases};
        if (keeps_pixels) {
            sweep.keep_pixels();
        }
        std::vector<float> biases;
        const auto record = sweep.hooks.record;
        sweep.hooks.record = [&](FinishedCurve&& finished) {
            biases.push_back(finished.curve.by_distance.front().bias);
            record(std::move(finished));
        };
        sweep.run();
        EXPECT_EQ(biases, (std::vector<float>{0.125F, 0.25F})) << "keeps pixels: " << keeps_pixels;
    }
}

TEST(SweepRunner, BisectsWhileGlHasTheLookupsMapAndReceivers)
{
    FakeSweep sweep{{"shadow_map.resolution=4,5", "lookup.filter=nearest,hardware",
                     tests::in_lane("bias.slope=0.0625", "bias.slope=0,0.0625"),
                     tests::in_lane("bias.constant=0.125", "bias.constant=0,0.125")},
                    {},
                    two_cameras()};
    EXPECT_EQ(sweep.run(), sweep.planned);
    EXPECT_THAT(sweep.failed, IsEmpty());
    expect_compared(sweep);
}

TEST(SweepRunner, KeepsMoreCamerasThanSlotsApart)
{
    std::vector<scene::CaseLayer> cameras;
    for (int i = 0; i < 5; ++i) {
        cameras.push_back(
            case_of(fmt::format("{}", i), {{"camera.eye", fmt::format("[{}, 5, 0]", i)}}));
    }
    for (const std::size_t slots : {1U, 2U, 3U, 8U}) {
        FakeSweep sweep{{"shadow_map.near=-2,-1", "shadow_map.resolution=4,8"}, {}, cameras};
        sweep.slots = slots;
        EXPECT_EQ(sweep.run(), sweep.planned);
        EXPECT_THAT(sweep.failed, IsEmpty());
        expect_compared(sweep);
    }
}

TEST(SweepRunner, OfNoStepDoesNothing)
{
    SweepHooks hooks;
    hooks.should_stop = [] { return false; };
    EXPECT_EQ(run_sweep({}, hooks), PlanCounts{});
}

} // namespace
} // namespace gnomon::analysis
