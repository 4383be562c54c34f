#include "analysis/sweep/units.hpp"

#include "analysis/sweep/plan.hpp"
#include "random_requests.hpp"
#include "scene/job/source.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Requests in the order of the plan's answers.
std::vector<std::size_t> answered(const SweepPlan& plan)
{
    std::vector<std::size_t> order;
    for (const SweepStep& step : plan.steps) {
        if (step.kind == SweepStep::Kind::answer) {
            order.push_back(step.curve);
        }
    }
    return order;
}

/// A wall with several shadow maps and slopes.
struct Grid {
    explicit Grid(const std::vector<std::string>& axes)
        : space{scene::builtin_job_source("wall", {}), axes}
    {
    }
    scene::SweepSpace space;
    SweepCurves curves{space, false, "1.0"};
    SweepPlan plan = make_plan(curves.requests(), 1);
};

TEST(SweepUnits, AreNeighboursAndAsManyAsAskedFor)
{
    std::mt19937 random{41};
    for (int round = 0; round < 300; ++round) {
        const auto requests = random_requests(random);
        const std::size_t count = 1 + random() % 8;
        SCOPED_TRACE(fmt::format("round {}, {} units: {}", round, count, text_of(requests, 2)));
        const SweepPlan plan = make_plan(requests, 2);
        const UnitDivision division = divide_into_units(plan, requests, count);
        const std::size_t units = std::min(count, requests.size());
        ASSERT_EQ(division.seconds.size(), units);
        ASSERT_EQ(division.unit_of.size(), requests.size());
        std::uint32_t last = 1;
        for (const std::size_t curve : answered(plan)) {
            const std::uint32_t unit = division.unit_of[curve];
            EXPECT_TRUE(unit == last || unit == last + 1) << "unit " << unit << " after " << last;
            last = unit;
        }
        EXPECT_EQ(last, units) << "no unit is empty";
    }
}

TEST(SweepUnits, TakeTheTimeOfTheirStepsAndOfWhatTheyRepeat)
{
    std::mt19937 random{42};
    for (int round = 0; round < 100; ++round) {
        const auto requests = random_requests(random);
        SCOPED_TRACE(fmt::format("round {}: {}", round, text_of(requests, 1)));
        const SweepPlan plan = make_plan(requests, 1);
        const UnitDivision division = divide_into_units(plan, requests, 4);
        for (std::uint32_t unit = 1; unit <= division.seconds.size(); ++unit) {
            std::vector<CurveRequest> own;
            for (std::size_t i = 0; i < requests.size(); ++i) {
                if (division.unit_of[i] == unit) {
                    own.push_back(requests[i]);
                }
            }
            // The plan of one unit numbers stages by its own requests, so it may run a stage more
            // or less often: in these small units 25 % is a few passes.
            const double alone = estimate_seconds(make_plan(own, 1), own);
            EXPECT_NEAR(division.seconds[unit - 1], alone, 0.25 * alone);
        }
    }
}

TEST(SweepUnits, BeginWhereTheMapChanges)
{
    const Grid grid{{"bias.slope=0,0.5,1", "shadow_map.resolution=256,257,258,259"}};
    const UnitDivision division = divide_into_units(grid.plan, grid.curves.requests(), 4);
    ASSERT_EQ(division.seconds.size(), 4U);
    for (std::size_t i = 0; i < grid.curves.requests().size(); ++i) {
        const scene::Job job = grid.curves.job(i);
        EXPECT_EQ(division.unit_of[i],
                  static_cast<std::uint32_t>(job.shadow_map.resolution_texels - 255));
    }
}

TEST(SweepUnits, BeginWhereTheCameraChangesRatherThanWhereTheMapDoes)
{
    // Two cameras with three equal maps each: halves are the cameras; thirds cut at maps.
    const Grid grid{{"image.width=64,65", "shadow_map.resolution=256,257,258"}};
    const UnitDivision halves = divide_into_units(grid.plan, grid.curves.requests(), 2);
    for (std::size_t i = 0; i < grid.curves.requests().size(); ++i) {
        const bool is_first = grid.curves.job(i).image.width_px == 64;
        EXPECT_EQ(halves.unit_of[i], is_first ? 1U : 2U);
    }
}

TEST(SweepUnits, AreTheSameEachTime)
{
    std::mt19937 random{43};
    const auto requests = random_requests(random);
    const SweepPlan plan = make_plan(requests, 2);
    const UnitDivision once = divide_into_units(plan, requests, 5);
    const UnitDivision again = divide_into_units(plan, requests, 5);
    EXPECT_EQ(once.unit_of, again.unit_of);
    EXPECT_EQ(once.seconds, again.seconds);
}

TEST(SweepUnits, AreOneOfFewCurvesAndNoneOfNone)
{
    const Grid grid{{"bias.constant=0,0.1"}};
    EXPECT_THAT(divide_into_units(grid.plan, grid.curves.requests(), 9).unit_of, Each(1U));
    EXPECT_EQ(default_unit_count(grid.plan, grid.curves.requests()), 1U);
    EXPECT_THAT(divide_into_units(SweepPlan{}, {}, 3).seconds, IsEmpty());
    EXPECT_THROW((void)divide_into_units(grid.plan, grid.curves.requests(), 0),
                 std::invalid_argument);
}

TEST(SweepUnits, HaveEveryOrdinalOnce)
{
    // Near beyond far is refused; the first unit has those.
    const Grid grid{{"shadow_map.resolution=256,257,258", "shadow_map.near=0.1,90",
                     "shadow_map.far=50", "bias.constant=0,0.001,0.002"}};
    ASSERT_FALSE(grid.curves.refusals().empty());
    const UnitDivision division = divide_into_units(grid.plan, grid.curves.requests(), 3);
    const auto units = ordinals_of_units(grid.curves, division.unit_of, 3);
    std::vector<std::uint64_t> all;
    for (const auto& unit : units) {
        EXPECT_TRUE(std::ranges::is_sorted(unit));
        EXPECT_EQ(ordinals_of(ordinal_runs(unit)), unit);
        all.insert(all.end(), unit.begin(), unit.end());
    }
    std::ranges::sort(all);
    std::vector<std::uint64_t> expected(grid.space.size());
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_EQ(all, expected);
    for (const std::uint64_t refused : grid.curves.refusals().front().ordinals) {
        EXPECT_TRUE(std::ranges::binary_search(units[0], refused));
    }
}

TEST(SweepUnits, OfAPartHaveTheCurvesOfTheWhole)
{
    const Grid grid{{"shadow_map.resolution=256,257", "bias.constant=0,0.001,0.002"}};
    const std::vector<std::uint64_t> part = grid.curves.requests()[1].ordinals;
    const SweepCurves curves{grid.space, part, "1.0"};
    ASSERT_EQ(curves.requests().size(), 1U);
    EXPECT_EQ(curves.requests()[0].ordinals, part);
    EXPECT_EQ(curves.requests()[0].keys.curve, grid.curves.requests()[1].keys.curve);
    const SceneIdentity scene{"0123456789abcdef", ""};
    EXPECT_EQ(curves.task(0, scene).id, grid.curves.task(1, scene).id);
}

TEST(SweepUnits, KeepEqualCurvesOfTwoFilesTogether)
{
    const scene::SweepSpace space{
        scene::job_source_of_text("job.toml", "scene.file = \"a.obj\"\n", {}),
        {"scene.file=a.obj,b.obj", "shadow_map.resolution=256,257"}};
    const SweepCurves curves{space, false, "1.0"};
    std::vector<std::uint32_t> parts{1, 2, 3, 4};
    ASSERT_EQ(curves.requests().size(), parts.size());
    keep_equals_together(curves, std::vector<SceneIdentity>(4, {"0123456789abcdef", ""}), parts);
    EXPECT_THAT(parts, ElementsAre(1, 2, 1, 2)) << "both files have the same content";
    parts = {1, 2, 3, 4};
    keep_equals_together(curves, std::vector<SceneIdentity>(4), parts);
    EXPECT_THAT(parts, ElementsAre(1, 2, 3, 4)) << "what cannot be read stays";
}

TEST(OrdinalRuns, AreAsLongAsTheyGo)
{
    const std::vector<std::uint64_t> ordinals{0, 1, 2, 10, 20, 30, 31};
    EXPECT_THAT(ordinal_runs(ordinals),
                ElementsAre(OrdinalRun{0, 3, 1}, OrdinalRun{10, 3, 10}, OrdinalRun{31, 1, 1}));
    EXPECT_THAT(ordinal_runs({}), IsEmpty());
}

using Kind = SweepStep::Kind;

TEST(SweepCost, KeepsFewerCamerasOfLargerImages)
{
    std::vector<CurveRequest> requests(1);
    requests[0].pixels = 1;
    const std::size_t most = camera_slots(requests);
    EXPECT_GE(most, 2U);
    std::size_t before = most;
    for (std::uint64_t pixels = 1; pixels <= std::uint64_t{1} << 28; pixels *= 2) {
        requests[0].pixels = pixels;
        EXPECT_LE(camera_slots(requests), before) << pixels;
        before = camera_slots(requests);
    }
    EXPECT_EQ(before, 1U);
    EXPECT_EQ(camera_slots({}), most);
}

TEST(SweepCost, KeepsFewerCamerasBesideLargerMaps)
{
    const auto slots = [](std::uint64_t pixels, std::uint64_t map_side) {
        std::vector<CurveRequest> requests(1);
        requests[0].pixels = pixels;
        requests[0].texels = map_side * map_side;
        return camera_slots(requests);
    };
    constexpr std::uint64_t hd = std::uint64_t{1280} * 720;
    constexpr std::uint64_t full_hd = std::uint64_t{1920} * 1080;
    EXPECT_EQ(slots(full_hd, 8192), 1U); // a sweep stays below 1.5 GiB
    EXPECT_GE(slots(full_hd, 4096), 2U);
    EXPECT_GE(slots(hd, 8192), 2U);
    EXPECT_GT(slots(hd, 1024), slots(hd, 8192));
}

TEST(SweepCost, GrowsWithTheWork)
{
    CurveRequest small;
    small.pixels = 1000;
    small.texels = 1000;
    small.ordinals = {0};
    CurveRequest large = small;
    large.pixels = 2'000'000;
    large.texels = 4'000'000;
    large.ordinals.resize(1000);
    for (const Kind kind : {Kind::draw_receivers, Kind::find_truth, Kind::draw_shadow_map,
                            Kind::prefilter, Kind::look_up, Kind::answer}) {
        const SweepStep step{kind, 0, 0};
        EXPECT_GT(estimate_seconds(step, small), 0) << static_cast<int>(kind);
        EXPECT_GT(estimate_seconds(step, large), estimate_seconds(step, small))
            << static_cast<int>(kind);
    }
    const std::vector<CurveRequest> requests{small, large};
    const SweepPlan plan = make_plan(requests, 1);
    double sum = 0;
    for (const SweepStep& step : plan.steps) {
        sum += estimate_seconds(step, requests[step.curve]);
    }
    EXPECT_EQ(estimate_seconds(plan, requests), sum);
    EXPECT_LT(estimate_bytes(make_plan(std::span{&small, 1}, 1), std::span{&small, 1}),
              estimate_bytes(plan, requests));
}

/// The cost of each request: its answer and the steps before it.
std::vector<double> costs_in_plan_order(const SweepPlan& plan,
                                        const std::vector<CurveRequest>& requests,
                                        std::vector<std::size_t>& order)
{
    std::vector<double> costs;
    double pending = 0;
    for (const SweepStep& step : plan.steps) {
        pending += estimate_seconds(step, requests[step.curve]);
        if (step.kind == Kind::answer) {
            costs.push_back(pending);
            order.push_back(step.curve);
            pending = 0;
        }
    }
    return costs;
}

TEST(SweepCost, DividesNeighboursEvenly)
{
    std::mt19937 random{26};
    for (int round = 0; round < 300; ++round) {
        const auto requests = random_requests(random);
        const auto shards = static_cast<std::uint32_t>(1 + random() % 6);
        SCOPED_TRACE(fmt::format("round {}, {} shards: {}", round, shards, text_of(requests, 2)));
        const SweepPlan plan = make_plan(requests, 2);
        std::vector<std::size_t> order;
        const auto costs = costs_in_plan_order(plan, requests, order);
        const auto shard_of = divide(plan, requests, shards);
        ASSERT_EQ(shard_of.size(), requests.size());
        std::vector<double> sums(shards);
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::uint32_t shard = shard_of[order[i]];
            ASSERT_GE(shard, 1U);
            ASSERT_LE(shard, shards);
            if (i > 0) {
                EXPECT_GE(shard, shard_of[order[i - 1]]) << "not contiguous";
            }
            sums[shard - 1] += costs[i];
        }
        // The middle of a request decides its part, so each end of a part is off by at most half a
        // request's cost.
        const double fair = std::accumulate(costs.begin(), costs.end(), 0.0) / shards;
        const double largest = *std::max_element(costs.begin(), costs.end());
        for (const double sum : sums) {
            // 1e-9: sums of up to some hundred doubles.
            EXPECT_NEAR(sum, fair, largest * (1 + 1e-9));
        }
    }
}

TEST(SweepCost, GivesOneShardEverything)
{
    std::mt19937 random{27};
    const auto requests = random_requests(random);
    EXPECT_THAT(divide(make_plan(requests, 1), requests, 1), ::testing::Each(1U));
}

} // namespace
} // namespace gnomon::analysis
