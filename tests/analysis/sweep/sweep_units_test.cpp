#include "analysis/sweep/units.hpp"

#include "analysis/sweep/cost.hpp"
#include "random_requests.hpp"
#include "scene/job/source.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
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

/// A wall under so many shadow maps and slopes.
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
            // A plan of its curves alone numbers their stages in the order of the requests, and so
            // may come to a stage more often or less: 25 % of these small units is some passes.
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
    // Of two cameras with three equal maps each, halves are the cameras; thirds cut at maps.
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
    // Near beyond far is refused: the first unit has those.
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

} // namespace
} // namespace gnomon::analysis
