#include "store/run/run_checks.hpp"

#include "example_comparison.hpp"
#include "example_run.hpp"
#include "store/merge/merge.hpp"
#include "store/run/run_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace gnomon::store {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

const ExampleRun checked_run{3, 2};

/// A curve that was checked against two reruns of 100 verdicts each, with some differences.
analysis::FinishedCurve verified(std::uint64_t number, std::uint64_t differences)
{
    analysis::FinishedCurve curve = checked_run.curve(number);
    curve.curve.verification =
        analysis::BiasVerification{{{0, 60, 40, differences}, {0.5F, 100, 0, 0}}};
    return curve;
}

RunStore planned(const std::filesystem::path& folder)
{
    std::filesystem::create_directories(folder);
    RunStore store{folder, RunStore::Access::write};
    store.plan(checked_run.description(), checked_run.configurations());
    return store;
}

TEST(RunChecks, KnowWhichCurvesWereVerified)
{
    const TemporaryFolder folder;
    RunStore store = planned(folder.path());
    store.record(verified(0, 0));
    store.record(checked_run.curve(2));
    const RunChecks checks = store.checks();
    EXPECT_EQ(checks.curves, 2U);
    EXPECT_EQ(checks.verified, 1U);
    EXPECT_EQ(checks.verdicts, 200U);
    EXPECT_TRUE(checks.are_passed());
    EXPECT_EQ(verification_text(checks), "1 of 2 bias curves, 0 of 200 verdicts differ");
    EXPECT_EQ(failed_checks_text(checks), "");
    EXPECT_THAT(store.unverified(), ElementsAre(4, 5));
    store.record(verified(2, 0));
    EXPECT_THAT(store.unverified(), IsEmpty());
}

TEST(RunChecks, DoNotPassWithADifference)
{
    const TemporaryFolder folder;
    {
        RunStore store = planned(folder.path());
        store.record(verified(1, 7));
        store.record(checked_run.curve(1)); // again, without being verified: what was found stays
    }
    const RunChecks checks = RunStore{folder.path(), RunStore::Access::read}.checks();
    EXPECT_EQ(checks.differences, 7U);
    EXPECT_FALSE(checks.are_passed());
    EXPECT_THAT(failed_checks_text(checks), StartsWith("7 verdicts of GL's reruns are not those"));
}

TEST(RunChecks, DoNotPassWithAMismatch)
{
    const TemporaryFolder folder;
    RunStore store = planned(folder.path());
    analysis::FinishedCurve curve = checked_run.curve(0);
    auto& reasons = curve.rows[1].result.metrics.pixels.by_reason;
    reasons[static_cast<std::size_t>(scene::ClassReason::mismatch)] = 5;
    store.record(curve);
    const RunChecks checks = store.checks();
    EXPECT_EQ(checks.mismatched, 1U);
    EXPECT_FALSE(checks.are_passed());
    EXPECT_THAT(failed_checks_text(checks),
                StartsWith("1 configuration with pixels that mismatch"));
}

TEST(RunChecks, LeaveOutWhatHasNoCurve)
{
    const TemporaryFolder folder;
    RunStore store = planned(folder.path());
    analysis::FinishedCurve curve = checked_run.curve(0);
    curve.curve.best.reset();
    store.record(curve);
    EXPECT_EQ(store.checks().curves, 0U);
    EXPECT_THAT(verification_text(store.checks()), StartsWith("nothing: "));
    EXPECT_THAT(store.unverified(), IsEmpty());
}

TEST(RunChecks, AreOfTheEnvironmentThatTheResultsComeFrom)
{
    const TemporaryFolder folder;
    RunStore store = planned(folder.path());
    store.record(verified(0, 7));
    RunDescription other = checked_run.description();
    other.environment.gl_version = "4.6";
    store.plan(other, checked_run.configurations(), Environments::several);
    store.record(checked_run.curve(0));
    EXPECT_EQ(store.checks().verified, 0U);
}

TEST(RunChecks, SayTheWorstThatMergedRunsFound)
{
    const TemporaryFolder folder;
    for (const std::uint64_t differences : {0U, 3U, 1U}) {
        RunStore store = planned(folder.path() / std::to_string(differences));
        store.record(verified(0, differences));
        store.record(verified(2, 0));
        store.record(checked_run.curve(1));
    }
    std::filesystem::create_directory(folder / "all");
    const std::vector<std::filesystem::path> runs{folder / "0", folder / "3", folder / "1"};
    merge_runs(folder / "all", runs, Environments::one);
    const RunChecks checks = RunStore{folder / "all", RunStore::Access::read}.checks();
    EXPECT_EQ(checks.curves, 3U);
    EXPECT_EQ(checks.verified, 2U);
    EXPECT_EQ(checks.differences, 3U);
}

} // namespace
} // namespace gnomon::store
