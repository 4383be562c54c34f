// Errors by distance at a job's bias, even if its curve was first computed for another job.

#include "csv_table.hpp"
#include "example_comparison.hpp"
#include "example_run.hpp"
#include "scene/error.hpp"
#include "store/merge/merge.hpp"
#include "store/run/run_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::store {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Block = std::pair<std::string, double>;
using Path = std::filesystem::path;

const ExampleRun biased_run{2, 3};

/// The example's configurations for a job with another constant bias.
std::vector<analysis::Configuration> configurations_at(const std::string& job_bias)
{
    auto all = biased_run.configurations();
    for (analysis::Configuration& configuration : all) {
        configuration.job_bias = job_bias;
    }
    return all;
}

analysis::FinishedCurve curve_at(std::uint64_t number, float job_bias)
{
    analysis::FinishedCurve finished = biased_run.curve(number);
    finished.curve.by_distance[0].bias = job_bias;
    return finished;
}

RunStore planned_at(const Path& folder, const std::string& job_bias)
{
    std::filesystem::create_directories(folder);
    RunStore store{folder, RunStore::Access::write};
    store.plan(biased_run.description(), configurations_at(job_bias));
    return store;
}

/// The biases of the blocks of error_vs_z.csv.
std::set<Block> blocks(const Path& folder)
{
    const CsvTable table = read_csv(folder / "error_vs_z.csv");
    std::set<Block> found;
    for (const auto& row : table.rows) {
        found.emplace(row.at("at"), std::stod(row.at("bias")));
    }
    EXPECT_EQ(table.rows.size() % 32, 0U);
    return found;
}

TEST(JobBias, OfAnotherJobIsMissingThoughEveryConfigurationIsDone)
{
    const TemporaryFolder folder;
    RunStore store = planned_at(folder.path(), "0");
    EXPECT_THAT(store.without_job_bias(), IsEmpty()) << "nothing is done";
    store.record(curve_at(0, 0));
    store.record(curve_at(1, 0));
    EXPECT_THAT(store.without_job_bias(), IsEmpty());
    EXPECT_EQ(store.plan(biased_run.description(), configurations_at("0.5")).done, 6U);
    EXPECT_THAT(store.without_job_bias(), ElementsAre(0, 3)) << "one for each curve";
    for (const std::uint64_t number : {0U, 1U}) {
        analysis::FinishedCurve curve = curve_at(number, 0.5F);
        curve.rows.resize(1);
        store.record(curve);
    }
    EXPECT_THAT(store.without_job_bias(), IsEmpty());
    store.write_csv();
    EXPECT_EQ(blocks(folder.path()), (std::set<Block>{{"job_bias", 0.5}, {"best_bias", 0.0015F}}));
    // The blocks of the first job stay.
    store.plan(biased_run.description(), configurations_at("0"));
    EXPECT_THAT(store.without_job_bias(), IsEmpty());
    store.write_csv();
    EXPECT_EQ(blocks(folder.path()), (std::set<Block>{{"job_bias", 0}, {"best_bias", 0.0015F}}));
}

TEST(JobBias, OfEachJobThatSharesACurveHasABlock)
{
    const TemporaryFolder folder;
    RunStore store{folder.path(), RunStore::Access::write};
    auto configurations = configurations_at("0");
    configurations[1].job_bias = "0.5"; // two cases that differ in what the axis replaces
    configurations[2].job_bias = "0.25 m";
    store.plan(biased_run.description(), configurations);
    for (const auto& [row, bias] : {std::pair{0U, 0.0F}, {1U, 0.5F}, {2U, 0.5F}}) {
        analysis::FinishedCurve curve = curve_at(0, bias);
        curve.rows = {curve.rows[row]};
        store.record(curve);
    }
    EXPECT_THAT(store.without_job_bias(), IsEmpty());
    store.write_csv();
    EXPECT_EQ(blocks(folder.path()),
              (std::set<Block>{{"job_bias", 0}, {"job_bias", 0.5}, {"best_bias", 0.0015F}}));
    EXPECT_EQ(read_csv(folder / "error_vs_z.csv").rows.size(), 3 * 32U)
        << "0.25 m is 0.5, and has no second block";
}

TEST(JobBias, IsNotAskedForWhereNoPixelIsScored)
{
    const TemporaryFolder folder;
    RunStore store = planned_at(folder.path(), "0");
    analysis::FinishedCurve curve = biased_run.curve(0);
    for (auto& row : curve.rows) {
        row.result.metrics.pixels.by_class = {921'600, 0, 0, 0, 0, 0, 0};
    }
    curve.curve.by_distance = {{analysis::DistanceProfile::At::job_bias, 0, {}},
                               {analysis::DistanceProfile::At::best_bias, 0, {}}};
    store.record(curve);
    EXPECT_THAT(store.without_job_bias(), IsEmpty());
}

TEST(JobBias, OfOverlappingRunsIsUnited)
{
    const TemporaryFolder folder;
    {
        RunStore first = planned_at(folder / "a", "0.5");
        first.record(curve_at(0, 0.5F));
        first.plan(biased_run.description(), configurations_at("0"));
        RunStore second = planned_at(folder / "b", "0");
        second.record(curve_at(0, 0));
        second.record(curve_at(1, 0));
    }
    const std::vector<Path> runs{folder / "a", folder / "b"};
    std::filesystem::create_directory(folder / "all");
    EXPECT_EQ(merge_runs(folder / "all", runs, Environments::one).counts.done, 6U);
    EXPECT_EQ(blocks(folder / "all"), (std::set<Block>{{"job_bias", 0}, {"best_bias", 0.0015F}}));
    EXPECT_EQ(read_csv(folder / "all" / "error_vs_z.csv").rows.size(), 2 * 2 * 32U);
}

TEST(JobBias, OfAnotherJobIsAnotherSweepsToMerge)
{
    const TemporaryFolder folder;
    planned_at(folder / "a", "0").record(curve_at(0, 0));
    planned_at(folder / "b", "0.5").record(curve_at(1, 0.5F));
    const std::vector<Path> runs{folder / "a", folder / "b"};
    std::filesystem::create_directory(folder / "all");
    EXPECT_THROW(merge_runs(folder / "all", runs, Environments::one), scene::InputError);
}

} // namespace
} // namespace gnomon::store
