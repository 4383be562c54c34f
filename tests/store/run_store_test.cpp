#include "store/run/run_store.hpp"

#include "csv_table.hpp"
#include "example_comparison.hpp"
#include "example_run.hpp"
#include "scene/error.hpp"
#include "store/run/run_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::store {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Access = RunStore::Access;
using Ordinals = std::vector<std::uint64_t>;

const ExampleRun small_run{2, 3};

RunStore planned_store(const TemporaryFolder& folder)
{
    RunStore store{folder.path(), Access::write};
    store.plan(small_run.description(), small_run.configurations());
    return store;
}

TEST(RunStore, StartsWithEverythingPlanned)
{
    const TemporaryFolder folder;
    RunStore store{folder.path(), Access::write};
    EXPECT_FALSE(store.has_configurations());
    const PlanOutcome outcome = store.plan(small_run.description(), small_run.configurations());
    EXPECT_TRUE(store.has_configurations());
    EXPECT_EQ(outcome.planned, 6U);
    EXPECT_EQ(outcome.done + outcome.failed + outcome.retired, 0U);
    EXPECT_THAT(store.ordinals(RunState::planned), ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(store.ordinals(RunState::done), IsEmpty());
}

TEST(RunStore, KnowsWhatWasRecorded)
{
    const TemporaryFolder folder;
    RunStore store = planned_store(folder);
    store.record(small_run.curve(1));
    store.record_failure(Ordinals{0, 2}, "out of\nmemory");
    EXPECT_THAT(store.ordinals(RunState::done), ElementsAre(3, 4, 5));
    EXPECT_THAT(store.ordinals(RunState::failed), ElementsAre(0, 2));
    EXPECT_THAT(store.ordinals(RunState::planned), ElementsAre(1));
    const auto rows = store.rows(RunState::failed, 1);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].ordinal, 0U);
    EXPECT_EQ(rows[0].case_name, "noon");
    EXPECT_EQ(rows[0].message, "out of?memory");
    ASSERT_EQ(rows[0].axes.size(), 2U);
    EXPECT_EQ(rows[0].axes[0],
              (std::pair<std::string, std::string>{"shadow_map.resolution", "256"}));
    EXPECT_EQ(rows[0].axes[1].first, "bias.constant");
}

TEST(RunStore, KeepsTheNotesOnItsScenes)
{
    const TemporaryFolder folder;
    RunDescription description = small_run.description();
    const scene::SceneNote note{"alpha_mask", 2, "2 materials"};
    const scene::SceneNote other{"alpha_blend", 1, "1 material"};
    add_notes(description.notes, "a.glb", std::vector{note}, 3);
    add_notes(description.notes, "a.glb", std::vector{note, other}, 3);
    add_notes(description.notes, "b.glb", std::vector{note}, 1);
    {
        RunStore store{folder.path(), Access::write};
        store.plan(description, small_run.configurations());
    }
    const RunStore store{folder.path(), Access::read};
    EXPECT_THAT(store.description().notes,
                ElementsAre(RunNote{"a.glb", note, 6}, RunNote{"a.glb", other, 3},
                            RunNote{"b.glb", note, 1}));
    EXPECT_THAT(note_sentences(store.description()),
                ElementsAre("a.glb: 2 materials", "a.glb: 1 material (in 3 of 6 configurations)",
                            "b.glb: 2 materials (in 1 of 6 configurations)"));
}

TEST(RunNotes, PassOverWhatIsNone)
{
    EXPECT_THAT(read_notes(""), IsEmpty()); // a run of before there were notes
    EXPECT_THAT(read_notes("[1, {\"scene\": \"a\"}, {}]"), IsEmpty());
}

TEST(RunStore, KeepsItAllForTheNextProcess)
{
    const TemporaryFolder folder;
    planned_store(folder).record(small_run.curve(1));
    RunStore store{folder.path(), Access::write};
    EXPECT_THAT(store.ordinals(RunState::done), ElementsAre(3, 4, 5));
    const PlanOutcome outcome = store.plan(small_run.description(), small_run.configurations());
    EXPECT_EQ(outcome.done, 3U);
    EXPECT_EQ(outcome.planned, 3U);
    store.record(small_run.curve(0));
    store.write_csv();

    const TemporaryFolder other;
    small_run.compute(other.path());
    EXPECT_EQ(csv_texts(folder.path()), csv_texts(other.path()));
}

TEST(RunStore, IsOneFileBetweenRuns)
{
    const TemporaryFolder folder;
    planned_store(folder).record(small_run.curve(1));
    EXPECT_EQ(folder.entry_count(), 1U);
    (void)RunStore{folder.path(), Access::read}.ordinals(RunState::done);
    EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(RunStore, IsReadWhileItIsWritten)
{
    const TemporaryFolder folder;
    RunStore writer = planned_store(folder);
    const RunStore reader{folder.path(), Access::read};
    EXPECT_THAT(reader.ordinals(RunState::done), IsEmpty());
    writer.record(small_run.curve(0));
    EXPECT_THAT(reader.ordinals(RunState::done), ElementsAre(0, 1, 2));
}

TEST(RunStore, RemembersWhatWasPlanned)
{
    const TemporaryFolder folder;
    RunDescription planned = small_run.description();
    planned.job = "[scene]\nfile = \"gr\xC3\xB6\xC3\x9F"
                  "er.obj\"\n";
    RunStore{folder.path(), Access::write}.plan(planned, small_run.configurations());
    const RunDescription read = RunStore{folder.path(), Access::read}.description();
    EXPECT_EQ(read.environment.gl_renderer, "llvmpipe");
    EXPECT_EQ(read.environment.gl_version, "4.5 Mesa");
    EXPECT_EQ(read.environment.embree, "Embree 3.13.5");
    EXPECT_EQ(read.environment.gnomon, "Gnomon 0.1.0");
    EXPECT_EQ(read.shard, (Shard{1, 1}));
    EXPECT_EQ(read.size, 6U);
    EXPECT_EQ(read.axes, planned.axes);
    EXPECT_EQ(read.job, planned.job);
    EXPECT_EQ(read.command, planned.command);
}

TEST(RunStore, TakesNewOrdinalsFromANewPlan)
{
    const TemporaryFolder folder;
    RunStore store = planned_store(folder);
    store.record(small_run.curve(0));
    store.record(small_run.curve(1));
    auto configurations = small_run.configurations();
    std::reverse(configurations.begin(), configurations.end());
    configurations.resize(4); // of curve 1 all, of curve 0 the last
    for (std::size_t i = 0; i < configurations.size(); ++i) {
        configurations[i].ordinal = 10 + i;
    }
    const PlanOutcome outcome = store.plan(small_run.description(), configurations);
    EXPECT_EQ(outcome.done, 4U);
    EXPECT_EQ(outcome.retired, 2U);
    EXPECT_THAT(store.ordinals(RunState::done), ElementsAre(10, 11, 12, 13));
    store.write_csv();
    const CsvTable table = read_csv(folder / "results.csv");
    ASSERT_EQ(table.rows.size(), 4U);
    EXPECT_EQ(table.rows[0].at("id"), configurations[0].id);
    EXPECT_EQ(table.rows[0].at("false_shadow"), "1005"); // the example's ordinal 5

    const PlanOutcome again = store.plan(small_run.description(), small_run.configurations());
    EXPECT_EQ(again.done, 6U); // what was retired is not lost
    EXPECT_EQ(again.retired, 0U);
}

TEST(RunStore, LeavesOutCurvesThatThePlanDoesNotAskFor)
{
    const TemporaryFolder folder;
    RunStore store = planned_store(folder);
    store.record(small_run.curve(0));
    store.record(small_run.curve(1));
    auto configurations = small_run.configurations();
    configurations.resize(3);
    store.plan(small_run.description(), configurations);
    store.write_csv();
    EXPECT_EQ(read_csv(folder / "bias_curves.csv").rows.size(), 100U);
    EXPECT_EQ(read_csv(folder / "error_vs_z.csv").rows.size(), 64U);
}

TEST(RunStore, GivesEqualJobsOneResultAndEachItsRow)
{
    const TemporaryFolder folder;
    RunStore store{folder.path(), Access::write};
    auto configurations = small_run.configurations();
    configurations[1].id = configurations[0].id; // two values of an axis that are the same job
    configurations[1].case_name = "evening";
    const PlanOutcome outcome = store.plan(small_run.description(), configurations);
    EXPECT_EQ(outcome.planned, 6U);
    EXPECT_TRUE(outcome.has_equal_ids);
    EXPECT_THAT(store.repeated(), ElementsAre(1));
    EXPECT_FALSE(store.plan(small_run.description(), small_run.configurations()).has_equal_ids);
    EXPECT_THAT(store.repeated(), IsEmpty());
    store.plan(small_run.description(), configurations);
    analysis::FinishedCurve curve = small_run.curve(0);
    curve.rows.erase(curve.rows.begin() + 1);
    store.record(curve);
    EXPECT_THAT(store.ordinals(RunState::done), ElementsAre(0, 1, 2));
    store.write_csv();
    const CsvTable table = read_csv(folder / "results.csv");
    EXPECT_EQ(table.rows[0].at("case"), "noon");
    EXPECT_EQ(table.rows[1].at("case"), "evening");
    EXPECT_EQ(table.rows[1].at("false_shadow"), table.rows[0].at("false_shadow"));
}

TEST(RunStore, TriesWhatFailedAgainWhenAsked)
{
    const TemporaryFolder folder;
    RunStore store = planned_store(folder);
    store.record_failure(Ordinals{1, 4}, "no memory");
    EXPECT_EQ(store.plan(small_run.description(), small_run.configurations()).failed, 2U);
    EXPECT_EQ(store.reset_failed(), 2U);
    EXPECT_THAT(store.ordinals(RunState::failed), IsEmpty());
    store.record(small_run.curve(0));
    store.record(small_run.curve(1));
    store.write_csv();
    EXPECT_THAT(read_text(folder / "results.csv"), Not(HasSubstr("no memory")));
}

TEST(RunStore, KeepsAResultAgainstALaterFailure)
{
    const TemporaryFolder folder;
    RunStore store = planned_store(folder);
    store.record(small_run.curve(0));
    store.record_failure(Ordinals{0}, "no memory");
    EXPECT_THAT(store.ordinals(RunState::done), ElementsAre(0, 1, 2));
    EXPECT_THAT(store.ordinals(RunState::failed), IsEmpty());
}

TEST(RunStore, SeesOnlyItsOwnShard)
{
    const TemporaryFolder folder;
    const ExampleRun divided{4, 2, 2};
    RunStore store{folder.path(), Access::write};
    EXPECT_EQ(store.plan(divided.description(2), divided.configurations()).planned, 4U);
    EXPECT_THAT(store.ordinals(RunState::planned), ElementsAre(2, 3, 6, 7));
    divided.record(store, 2);
    store.write_csv();
    EXPECT_EQ(read_csv(folder / "results.csv").rows.size(), 4U);
    EXPECT_EQ(store.description().shard, (Shard{2, 2}));
}

TEST(RunStore, RefusesResultsOfTwoEnvironments)
{
    const TemporaryFolder folder;
    RunStore store = planned_store(folder);
    RunDescription elsewhere = small_run.description();
    elsewhere.environment.gl_version = "4.6 Mesa";
    EXPECT_NO_THROW(store.plan(elsewhere, small_run.configurations())); // no results yet
    store.record(small_run.curve(0));
    try {
        store.plan(small_run.description(), small_run.configurations());
        ADD_FAILURE() << "mixed two environments";
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(),
                    AllOf(HasSubstr("gl_version was \"4.6 Mesa\" and is \"4.5 Mesa\""),
                          HasSubstr("name another folder"), HasSubstr("--allow-mixed"),
                          Not(HasSubstr("\n"))));
    }
    EXPECT_EQ(store.description().environment.gl_version, "4.6 Mesa"); // nothing changed
    store.plan(small_run.description(), small_run.configurations(), Environments::several);
    EXPECT_THAT(store.ordinals(RunState::done), ElementsAre(0, 1, 2));
}

TEST(RunStore, RefusesWhatWasNotPlanned)
{
    const TemporaryFolder folder;
    RunStore store = planned_store(folder);
    analysis::FinishedCurve unknown = small_run.curve(0);
    unknown.curve.id = "unknown";
    EXPECT_THROW(store.record(unknown), std::invalid_argument);
    analysis::FinishedCurve other_rows = small_run.curve(0);
    other_rows.rows.back().ordinal = 3; // of curve 1
    EXPECT_THROW(store.record(other_rows), std::invalid_argument);
    EXPECT_THROW(store.record_failure(Ordinals{0, 6}, "late"), std::invalid_argument);
    EXPECT_EQ(store.ordinals(RunState::planned).size(), 6U); // all or nothing
}

TEST(RunStore, RefusesAPlanThatIsNone)
{
    const TemporaryFolder folder;
    RunStore store{folder.path(), Access::write};
    auto twice = small_run.configurations();
    twice[1].ordinal = 0;
    EXPECT_THROW(store.plan(small_run.description(), twice), std::invalid_argument);
    auto unknown_key = small_run.configurations();
    unknown_key[0].parameters.emplace_back("bias.variable", "1");
    EXPECT_THROW(store.plan(small_run.description(), unknown_key), std::invalid_argument);
    EXPECT_THROW(store.plan(small_run.description(2), small_run.configurations()),
                 std::invalid_argument);
    EXPECT_THAT(store.ordinals(RunState::planned), IsEmpty());
}

TEST(RunStore, HasNothingToReadWhereNothingWasWritten)
{
    const TemporaryFolder folder;
    try {
        const RunStore store{folder.path(), Access::read};
        ADD_FAILURE() << "read nothing";
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("there is no results.sqlite in it"));
    }
    EXPECT_EQ(folder.entry_count(), 0U);
}

} // namespace
} // namespace gnomon::store
