#include "store/merge/merge.hpp"

#include "csv_table.hpp"
#include "example_comparison.hpp"
#include "example_run.hpp"
#include "scene/error.hpp"
#include "store/run/run_status.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::store {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Paths = std::vector<std::filesystem::path>;

const ExampleRun divided{7, 5, 5};

/// The five shards, computed.
Paths shards(const TemporaryFolder& folder)
{
    Paths runs;
    for (std::uint32_t shard = 1; shard <= 5; ++shard) {
        runs.push_back(folder / fmt::format("part {}?#%", shard));
        divided.compute(runs.back(), shard);
    }
    return runs;
}

PlanOutcome merge(const std::filesystem::path& out, const Paths& runs,
                  Environments environments = Environments::one)
{
    std::filesystem::create_directories(out);
    return merge_runs(out, runs, environments).counts;
}

std::string refusal(const std::filesystem::path& out, const Paths& runs,
                    Environments environments = Environments::one)
{
    try {
        (void)merge(out, runs, environments);
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return "merged";
}

std::string undivided_csv(const TemporaryFolder& folder)
{
    ExampleRun{divided.curves, divided.biases}.compute(folder / "whole");
    return csv_texts(folder / "whole");
}

TEST(Merge, OfAllShardsIsTheUndividedRun)
{
    const TemporaryFolder folder;
    Paths runs = shards(folder);
    std::vector<std::string> before;
    for (const auto& run : runs) {
        before.push_back(read_text(run / "results.sqlite"));
    }
    const PlanOutcome outcome = merge(folder / "all", runs);
    EXPECT_EQ(outcome.done, 35U);
    EXPECT_EQ(outcome.failed + outcome.planned, 0U);
    EXPECT_EQ(csv_texts(folder / "all"), undivided_csv(folder));
    for (std::size_t i = 0; i < runs.size(); ++i) {
        EXPECT_EQ(read_text(runs[i] / "results.sqlite"), before[i]) << runs[i];
    }
    EXPECT_TRUE(read_run_status(folder / "all", 1).is_complete());
}

/// A run of two parts whose lights have three maps.
const ExampleRun of_several_maps{2, 3, 2, 3};

Paths parts_with_maps(const TemporaryFolder& folder)
{
    Paths runs{folder / "first", folder / "second"};
    of_several_maps.compute(runs[0], 1);
    of_several_maps.compute(runs[1], 2);
    return runs;
}

TEST(Merge, TakesErrorsByMapAlong)
{
    const TemporaryFolder folder;
    const Paths runs = parts_with_maps(folder);
    (void)merge(folder / "all", {runs[1], runs[0], runs[1]});
    ExampleRun{2, 3, 1, 3}.compute(folder / "whole");
    EXPECT_EQ(read_text(folder / "all/by_map.csv"), read_text(folder / "whole/by_map.csv"));
}

TEST(Merge, TakesRunsThatAreOlderThanErrorsByMap)
{
    const TemporaryFolder folder;
    const Paths runs = parts_with_maps(folder);
    sqlite::Database{runs[0] / "results.sqlite", sqlite::Database::Access::write}.run(
        "DROP TABLE map_errors");
    EXPECT_EQ(merge(folder / "all", runs).done, 6U);
    EXPECT_EQ(read_csv(folder / "all/by_map.csv").rows.size(), 3 * 3U);
}

TEST(Merge, RefusesErrorsByMapThatDiffer)
{
    const TemporaryFolder folder;
    const Paths runs = parts_with_maps(folder);
    of_several_maps.compute(folder / "other", 1);
    sqlite::Database{folder / "other/results.sqlite", sqlite::Database::Access::write}.run(
        "UPDATE map_errors SET lit = lit + 1 WHERE map_index = 1");
    EXPECT_THAT(refusal(folder / "all", {runs[0], folder / "other"}),
                AllOf(HasSubstr("configuration "), HasSubstr(" has another error by map than")));
}

TEST(Merge, DoesNotDependOnTheOrderOrOnRunsGivenTwice)
{
    const TemporaryFolder folder;
    Paths runs = shards(folder);
    std::reverse(runs.begin(), runs.end());
    runs.push_back(runs[1]);
    (void)merge(folder / "all", runs);
    EXPECT_EQ(csv_texts(folder / "all"), undivided_csv(folder));
}

TEST(Merge, TakesMoreRunsThanSqliteAttaches)
{
    const TemporaryFolder folder;
    const ExampleRun many{30, 1, 15};
    Paths runs;
    for (std::uint32_t shard = 1; shard <= 15; ++shard) {
        runs.push_back(folder / fmt::format("{}", shard));
        many.compute(runs.back(), shard);
    }
    EXPECT_EQ(merge(folder / "all", runs).done, 30U);
}

TEST(Merge, TakesPartsThatKnowOnlyTheirOwnPlan)
{
    const TemporaryFolder folder;
    Paths runs;
    for (std::uint32_t shard = 1; shard <= 5; ++shard) {
        std::vector<analysis::Configuration> own;
        for (const analysis::Configuration& configuration : divided.configurations()) {
            if (configuration.shard == shard) {
                own.push_back(configuration);
            }
        }
        runs.push_back(folder / fmt::format("{}", shard));
        std::filesystem::create_directory(runs.back());
        RunStore store{runs.back(), RunStore::Access::write};
        store.plan(divided.description(shard), own);
        divided.record(store, shard);
    }
    EXPECT_EQ(merge(folder / "all", runs).done, 35U);
    EXPECT_EQ(csv_texts(folder / "all"), undivided_csv(folder));
    EXPECT_EQ(merge(folder / "some", {runs[0], runs[1]}).planned, 15U);
}

TEST(Merge, CountsWhatIsMissing)
{
    const TemporaryFolder folder;
    Paths runs = shards(folder);
    runs.pop_back();
    EXPECT_EQ(merge(folder / "all", runs).planned, 5U);
    const RunStatus status = read_run_status(folder / "all", 3);
    EXPECT_EQ(status.missing, 5U);
    ASSERT_EQ(status.missing_rows.size(), 3U);
    EXPECT_EQ(status.missing_rows[0].ordinal, 20U);
}

TEST(Merge, PrefersResultsToFailuresAndFailuresToNothing)
{
    const TemporaryFolder folder;
    const ExampleRun whole{2, 2};
    const Paths runs{folder / "a", folder / "b"};
    for (const auto& run : runs) {
        std::filesystem::create_directory(run);
        RunStore store{run, RunStore::Access::write};
        store.plan(whole.description(), whole.configurations());
        if (run == runs[0]) {
            store.record_failure(std::vector<std::uint64_t>{0, 1, 2}, "no memory");
        } else {
            store.record(whole.curve(0));
        }
    }
    for (const bool is_reversed : {false, true}) {
        const auto out = folder / (is_reversed ? "ba" : "ab");
        const PlanOutcome outcome = merge(out, is_reversed ? Paths{runs[1], runs[0]} : runs);
        EXPECT_EQ(outcome.done, 2U);
        EXPECT_EQ(outcome.failed, 1U);
        EXPECT_EQ(outcome.planned, 1U);
        const auto rows = read_csv(out / "results.csv").rows;
        EXPECT_EQ(rows[1].at("message"), "");
        EXPECT_EQ(rows[2].at("message"), "no memory");
    }
}

/// A copy of a run with one changed curve.
std::string refusal_of_changed(const std::function<void(analysis::FinishedCurve&)>& change)
{
    const TemporaryFolder folder;
    const ExampleRun whole{2, 2};
    whole.compute(folder / "a");
    std::filesystem::create_directory(folder / "b");
    {
        RunStore store{folder / "b", RunStore::Access::write};
        store.plan(whole.description(), whole.configurations());
        analysis::FinishedCurve curve = whole.curve(1);
        change(curve);
        store.record(curve);
    }
    return refusal(folder / "all", {folder / "a", folder / "b"});
}

TEST(Merge, RefusesResultsThatDiffer)
{
    const auto configurations = ExampleRun{2, 2}.configurations();
    EXPECT_EQ(refusal_of_changed([](analysis::FinishedCurve&) {}), "merged");
    EXPECT_THAT(refusal_of_changed([](analysis::FinishedCurve& curve) {
                    curve.rows[1].result.metrics.false_lit += 1;
                }),
                AllOf(HasSubstr("/b: configuration " + configurations[3].id),
                      HasSubstr("another false_lit than"), HasSubstr("leave one of them out")));
    EXPECT_THAT(refusal_of_changed([](analysis::FinishedCurve& curve) {
                    curve.curve.map_bytes.reset(); // NULL in one of the two
                }),
                HasSubstr("another map_bytes than"));
    EXPECT_THAT(
        refusal_of_changed([](analysis::FinishedCurve& curve) {
            curve.curve.near_m = *curve.curve.near_m + 1e-15;
        }),
        AllOf(HasSubstr("curve " + configurations[2].curve), HasSubstr("another map_near_m")));
    EXPECT_THAT(refusal_of_changed([](analysis::FinishedCurve& curve) {
                    curve.curve.points.back().counts.false_lit = 0;
                }),
                HasSubstr("another bias curve"));
    EXPECT_THAT(refusal_of_changed([](analysis::FinishedCurve& curve) {
                    curve.curve.by_distance[1].bins[5].counts.lit = 0;
                }),
                HasSubstr("another error by distance"));
}

TEST(Merge, RefusesOtherEnvironmentsUnlessTheyAreAllowed)
{
    const TemporaryFolder folder;
    const ExampleRun two{2, 2, 2};
    two.compute(folder / "a", 1);
    std::filesystem::create_directory(folder / "b");
    {
        RunDescription description = two.description(2);
        description.environment.gl_renderer = "another";
        RunStore store{folder / "b", RunStore::Access::write};
        store.plan(description, two.configurations());
        two.record(store, 2);
    }
    const Paths runs{folder / "a", folder / "b"};
    EXPECT_THAT(refusal(folder / "all", runs),
                AllOf(HasSubstr("/b: was computed in another environment (another, GL 4.5 Mesa"),
                      HasSubstr("--allow-mixed")));
    EXPECT_EQ(merge(folder / "all", runs, Environments::several).done, 4U);
    EXPECT_THAT(refusal(folder / "again", {folder / "all"}), HasSubstr("2 environments"));
    EXPECT_EQ(merge(folder / "again", {folder / "all"}, Environments::several).done, 4U);
}

TEST(Merge, RefusesPartsOfOtherSweeps)
{
    const TemporaryFolder folder;
    ExampleRun{2, 2, 2}.compute(folder / "a", 1);
    ExampleRun{2, 3, 2}.compute(folder / "larger", 2);
    EXPECT_THAT(refusal(folder / "all", {folder / "a", folder / "larger"}),
                HasSubstr("belongs to another sweep than"));
    ExampleRun{4, 1, 2}.compute(folder / "other", 2);
    EXPECT_THAT(refusal(folder / "all", {folder / "a", folder / "other"}),
                HasSubstr("/other: belongs to another sweep"));
}

TEST(Merge, RefusesFoldersThatAreNotWhatTheyShouldBe)
{
    const TemporaryFolder folder;
    const Paths runs = shards(folder);
    EXPECT_THAT(refusal(runs[0], {runs[1]}), HasSubstr("holds a run already"));
    EXPECT_THAT(refusal(runs[0], runs), HasSubstr("holds a run already"));
    EXPECT_THAT(refusal(folder / "all", {folder / "none"}),
                HasSubstr("there is no results.sqlite"));
    std::filesystem::create_directory(folder / "empty");
    {
        const RunStore unplanned{folder / "empty", RunStore::Access::write};
    }
    EXPECT_THAT(refusal(folder / "all", {folder / "empty"}),
                HasSubstr("no configuration is planned"));
}

TEST(Merge, StartsAnewAfterOneThatWasRefused)
{
    const TemporaryFolder folder;
    Paths runs = shards(folder);
    ExampleRun{35, 1, 5}.compute(folder / "other", 3);
    Paths wrong = runs;
    wrong.push_back(folder / "other");
    EXPECT_THAT(refusal(folder / "all", wrong), HasSubstr("belongs to another sweep"));
    EXPECT_EQ(merge(folder / "all", runs).done, 35U);
    EXPECT_EQ(csv_texts(folder / "all"), undivided_csv(folder));
}

} // namespace
} // namespace gnomon::store
