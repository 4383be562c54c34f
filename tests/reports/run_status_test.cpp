#include "reports/tables/run_status_text.hpp"

#include "example_comparison.hpp"
#include "example_run.hpp"
#include "scene/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

using nlohmann::json;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const store::ExampleRun two_case_run{4, 2, 2};

/// A run of shard 2 with one failed and two missing configurations.
void make_incomplete(const std::filesystem::path& folder)
{
    std::filesystem::create_directories(folder);
    store::RunStore store{folder, store::RunStore::Access::write};
    store.plan(two_case_run.description(2), two_case_run.configurations());
    store.record_failure(std::vector<std::uint64_t>{7}, "light.obj: no such file");
    analysis::FinishedCurve half = two_case_run.curve(3);
    half.rows.pop_back();
    store.record(half);
}

TEST(RunStatus, ListsWhatFailedAndWhatIsMissing)
{
    const store::TemporaryFolder folder;
    make_incomplete(folder / "it's");
    const std::string text = run_status_text(store::read_run_status(folder / "it's", 1));
    EXPECT_THAT(text,
                HasSubstr(": 1 of 4 configurations done, 1 failed, 2 missing, shard 2 of 2\n"));
    EXPECT_THAT(text, HasSubstr("\nfailed\n  7  case noon  shadow_map.resolution = 259  "
                                "bias.constant = 1.0100000054080738e-06: light.obj: no such"));
    EXPECT_THAT(text, HasSubstr("\nmissing\n  2  case noon  shadow_map.resolution = 257"));
    EXPECT_THAT(text, HasSubstr("  and 1 more\n"));
    EXPECT_THAT(text, HasSubstr("resume with\n  gnomon sweep job.toml --out '"));
    EXPECT_THAT(text, EndsWith("/it'\\''s' --shard 2/2 --retry failed\n"));
}

TEST(RunStatus, IsShortWhenAllIsDone)
{
    const store::TemporaryFolder folder;
    two_case_run.compute(folder.path(), 1);
    const store::RunStatus status = store::read_run_status(folder.path(), 20);
    EXPECT_TRUE(status.is_complete());
    EXPECT_EQ(run_status_text(status), folder.path().string() +
                                           ": 4 of 4 configurations done, 0 failed, 0 missing, "
                                           "shard 1 of 2\n");
}

TEST(RunStatus, DoesNotAdviseToRetryWhatCannotPass)
{
    const store::TemporaryFolder folder;
    store::RunStore store{folder.path(), store::RunStore::Access::write};
    store.plan(two_case_run.description(1), two_case_run.configurations());
    const std::vector<std::uint64_t> refused{0, 1};
    store.record_failure(refused, "near is beyond far", analysis::Retry::is_useless);
    store.record(two_case_run.curve(2));
    const store::RunStatus status = store::read_run_status(folder.path(), 20);
    EXPECT_EQ(status.failed, 2U);
    EXPECT_EQ(status.retriable, 0U);
    const std::string text = run_status_text(status);
    EXPECT_THAT(text, Not(HasSubstr("--retry")));
    EXPECT_THAT(text, Not(HasSubstr("resume with"))) << "nothing is missing";
    EXPECT_THAT(text, HasSubstr("\n2 failed configurations cannot pass as they are given: change "
                                "the keys that the message names"));
    store.reset_failed();
    store.record_failure(refused, "no memory");
    EXPECT_THAT(run_status_text(store::read_run_status(folder.path(), 20)),
                EndsWith("--retry failed\n"));
}

TEST(RunStatus, SaysTheSameInJson)
{
    const store::TemporaryFolder folder;
    make_incomplete(folder.path());
    const json object = json::parse(run_status_json(store::read_run_status(folder.path(), 20)));
    EXPECT_EQ(object.at("schema"), 1);
    EXPECT_EQ(object.at("complete"), false);
    EXPECT_EQ(object.at("done"), 1);
    EXPECT_EQ(object.at("failed"), 1);
    EXPECT_EQ(object.at("missing"), 2);
    EXPECT_EQ(object.at("retriable"), 1);
    EXPECT_EQ(object.at("shard"), "2/2");
    EXPECT_EQ(object.at("sweep_size"), 8);
    EXPECT_EQ(object.at("environment").at("embree"), "Embree 3.13.5");
    EXPECT_EQ(object.at("failed_configurations").at(0).at("ordinal"), 7);
    EXPECT_EQ(object.at("failed_configurations").at(0).at("message"), "light.obj: no such file");
    const json& missing = object.at("missing_configurations").at(1);
    EXPECT_EQ(missing.at("ordinal"), 3);
    EXPECT_EQ(missing.at("case"), "noon");
    EXPECT_EQ(missing.at("axes").at("shadow_map.resolution"), "257");
    EXPECT_THAT(object.at("resume").get<std::string>(), StartsWith("gnomon sweep job.toml --out "));
}

TEST(RunStatus, RefusesAFolderWithoutARun)
{
    const store::TemporaryFolder folder;
    EXPECT_THROW((void)store::read_run_status(folder.path(), 20), scene::InputError);
    {
        const store::RunStore unplanned{folder.path(), store::RunStore::Access::write};
    }
    EXPECT_THROW((void)store::read_run_status(folder.path(), 20), scene::InputError);
}

TEST(RunStatus, LeavesTheCommandOutWhereItIsNotKnown)
{
    const store::TemporaryFolder folder;
    store::RunDescription description = two_case_run.description();
    description.command.clear();
    store::RunStore{folder.path(), store::RunStore::Access::write}.plan(
        description, two_case_run.configurations());
    EXPECT_THAT(run_status_text(store::read_run_status(folder.path(), 0)),
                Not(HasSubstr("resume")));
}

TEST(RunStatus, SaysThatNothingIsRecordedYetWhereTheDiskWasFullAtOnce)
{
    // SQLite may leave an empty file, or one with only its first page.
    for (const char* const statement : {"", "PRAGMA journal_mode = WAL; PRAGMA user_version = 0; "
                                            "CREATE TABLE t (a); DROP TABLE t"}) {
        const store::TemporaryFolder folder;
        {
            const store::sqlite::Database database{store::results_path(folder.path()),
                                                   store::sqlite::Database::Access::write};
            database.run(statement);
        }
        try {
            (void)store::read_run_status(folder.path(), 20);
            ADD_FAILURE() << statement;
        } catch (const scene::InputError& error) {
            EXPECT_THAT(error.what(), EndsWith("results.sqlite: nothing is recorded in it yet, for "
                                               "the run was cut off as it was begun: repeat the "
                                               "command that began it"));
        }
        two_case_run.compute(folder.path(), 1); // the sweep continues
        EXPECT_TRUE(store::read_run_status(folder.path(), 20).is_complete());
    }
}

} // namespace
} // namespace gnomon::reports
