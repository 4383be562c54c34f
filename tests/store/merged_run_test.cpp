
#include "example_comparison.hpp"
#include "scene/error.hpp"
#include "store/units/merged_run.hpp"
#include "unit_sweep.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace gnomon::store {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// The description of the whole sweep, whose environment comes from the units.
RunDescription planned(const UnitSweep& sweep)
{
    RunDescription description = sweep.run().description();
    description.shard = {};
    description.environment = {};
    description.environment.gnomon = sweep.gnomon;
    return description;
}

PlannedUnit unit_of(std::uint32_t number)
{
    return {unit_name(number), number, 1, 3, {}, {{std::uint64_t{number - 1} * 3, 3, 1}}};
}

/// RUN, reopened.
MergedRun opened(const fs::path& run, const UnitSweep& sweep,
                 Environments environments = Environments::one, Failures failures = Failures::kept)
{
    fs::create_directories(run);
    return {run, planned(sweep), environments, failures};
}

template <typename Work>
std::string refusal_of_work(const Work& work)
{
    try {
        work();
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return "done";
}

TEST(MergedRuns, OfUnitsInAnyOrderAreOneMachinesSweep)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    std::vector<fs::path> files = sweep.compute_all(folder / "units");
    std::shuffle(files.begin(), files.end(), std::mt19937{7});
    for (std::size_t i = 0; i < files.size(); ++i) {
        MergedRun run = opened(folder / "run", sweep); // as after each the client was killed
        EXPECT_EQ(run.outcome().done, 3 * i);
        EXPECT_EQ(run.take(files[i], sweep.plan).outcome.done, 3U);
    }
    const MergedRun run = opened(folder / "run", sweep);
    for (std::uint32_t number = 1; number <= sweep.units; ++number) {
        EXPECT_TRUE(run.has(unit_of(number)));
    }
    EXPECT_EQ(run.outcome().planned, 0U);
    run.write_csv();
    EXPECT_EQ(csv_texts(folder / "run"), sweep.whole_csv(folder.path()));
}

TEST(MergedRuns, TryAgainOnlyWhatFailed)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    UnitSweep failing = sweep;
    failing.fails = true;
    {
        MergedRun run = opened(folder / "run", sweep);
        static_cast<void>(run.take(sweep.compute(folder / "units", 1), sweep.plan));
        static_cast<void>(run.take(failing.compute(folder / "units", 2), sweep.plan));
        EXPECT_EQ(run.retriable(), 3U);
        EXPECT_EQ(run.outcome().failed, 3U);
    }
    EXPECT_TRUE(opened(folder / "run", sweep).has(unit_of(2)));
    MergedRun again = opened(folder / "run", sweep, Environments::one, Failures::tried_again);
    EXPECT_TRUE(again.has(unit_of(1)));
    EXPECT_FALSE(again.has(unit_of(2)));
    EXPECT_FALSE(again.has(unit_of(3)));
    static_cast<void>(again.take(sweep.compute(folder / "again", 2), sweep.plan));
    EXPECT_EQ(again.outcome().done, 6U);
    EXPECT_EQ(again.outcome().failed, 0U);
    EXPECT_EQ(again.retriable(), 0U);
}

TEST(MergedRuns, AreOfOneEnvironmentUnlessSeveralAreAllowed)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    UnitSweep elsewhere = sweep;
    elsewhere.gl_renderer = "another";
    const fs::path other = elsewhere.compute(folder / "other", 2);
    MergedRun run = opened(folder / "run", sweep);
    static_cast<void>(run.take(sweep.compute(folder / "units", 1), sweep.plan));
    EXPECT_THAT(refusal_of_work([&] { static_cast<void>(run.take(other, sweep.plan)); }),
                HasSubstr("was computed in another environment (another, GL "));
    EXPECT_EQ(run.outcome().done, 3U);
    MergedRun mixed = opened(folder / "run", sweep, Environments::several);
    static_cast<void>(mixed.take(other, sweep.plan));
    EXPECT_EQ(mixed.outcome().done, 6U);
}

TEST(MergedRuns, RefuseOtherPlansAndOtherSweeps)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    MergedRun run = opened(folder / "run", sweep);
    const fs::path file = sweep.compute(folder / "units", 1);
    EXPECT_THAT(refusal_of_work([&] { static_cast<void>(run.take(file, "00000000000000ff")); }),
                HasSubstr("belongs to plan 00000000000000aa, the sweep to plan 00000000000000ff"));
    EXPECT_EQ(run.outcome().done, 0U);
    UnitSweep longer = sweep;
    longer.units = 13;
    EXPECT_THAT(refusal_of_work([&] { static_cast<void>(opened(folder / "run", longer)); }),
                HasSubstr("holds another sweep, or a part of one"));
}

TEST(MergedRuns, LeaveOutUnitsThatAreNotWhole)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    MergedRun run = opened(folder / "run", sweep);
    const fs::path file = sweep.compute(folder / "units", 1);
    fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_THROW(static_cast<void>(run.take(file, sweep.plan)), sqlite::DamagedDatabase);
    EXPECT_EQ(run.outcome().done, 0U);
    static_cast<void>(run.take(sweep.compute(folder / "units", 1), sweep.plan));
    EXPECT_EQ(run.outcome().done, 3U);
}

} // namespace
} // namespace gnomon::store
