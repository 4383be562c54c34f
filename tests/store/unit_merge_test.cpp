
#include "example_comparison.hpp"
#include "scene/error.hpp"
#include "store/merge/merge.hpp"
#include "store/output_file.hpp"
#include "store/run/run_status.hpp"
#include "store/units/unit_file.hpp"
#include "unit_sweep.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <vector>

namespace gnomon::store {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

MergeOutcome merged(const fs::path& out, const std::vector<fs::path>& inputs)
{
    fs::create_directories(out);
    return merge_runs(out, inputs, Environments::one);
}

std::string refusal_of_merge(const fs::path& out, const std::vector<fs::path>& inputs)
{
    try {
        (void)merged(out, inputs);
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return "united";
}

TEST(Units, InAnyOrderAreOneMachinesSweep)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    std::vector<fs::path> files = sweep.compute_all(folder / "units");
    std::shuffle(files.begin(), files.end(), std::mt19937{5});
    const MergeOutcome outcome = merged(folder / "all", files);
    EXPECT_EQ(outcome.counts.done, 36U);
    EXPECT_EQ(outcome.unit_count, 12U);
    EXPECT_THAT(outcome.missing_units, IsEmpty());
    EXPECT_EQ(csv_texts(folder / "all"), sweep.whole_csv(folder.path()));
    const RunStatus status = read_run_status(folder / "all", 1);
    EXPECT_TRUE(status.is_complete());
    ASSERT_THAT(status.description.notes, SizeIs(1));
    EXPECT_EQ(status.description.notes[0].configurations, 36U) << "those of all units";
}

TEST(Units, OfAFolderAreAllOfThem)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    sweep.compute_all(folder / "units");
    EXPECT_EQ(merged(folder / "all", {folder / "units"}).counts.done, 36U);
    EXPECT_EQ(csv_texts(folder / "all"), sweep.whole_csv(folder.path()));
}

TEST(Units, GivenTwiceCountOnce)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    std::vector<fs::path> files = sweep.compute_all(folder / "units");
    files.push_back(files[3]);
    files.push_back(sweep.compute(folder / "again", 7));
    const MergeOutcome outcome = merged(folder / "all", files);
    EXPECT_EQ(outcome.repeated, 2U);
    EXPECT_EQ(outcome.counts.done, 36U);
    EXPECT_EQ(read_run_status(folder / "all", 1).description.notes.at(0).configurations, 36U);
    EXPECT_EQ(csv_texts(folder / "all"), sweep.whole_csv(folder.path()));
}

TEST(Units, ThatAreMissingAreNamed)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    std::vector<fs::path> files = sweep.compute_all(folder / "units");
    files.erase(files.begin() + 8);
    files.erase(files.begin() + 2);
    const MergeOutcome outcome = merged(folder / "all", files);
    EXPECT_THAT(outcome.missing_units, ElementsAre(3, 9));
    EXPECT_EQ(outcome.counts.planned, 6U);
    EXPECT_EQ(read_run_status(folder / "all", 1).missing, 6U);
}

TEST(Units, ThatAreNotWholeAreNamedAndTheOthersUnited)
{
    const TemporaryFolder folder;
    const UnitSweep sweep;
    const std::vector<fs::path> files = sweep.compute_all(folder / "units");
    const auto size = fs::file_size(files[0]);
    fs::resize_file(files[0], 0);
    fs::resize_file(files[4], size / 2);
    fs::resize_file(files[5], size - 1);
    fs::resize_file(files[6], 100);
    write_file(files[11], "rubbish, and no database");
    const MergeOutcome outcome = merged(folder / "all", files);
    ASSERT_THAT(outcome.damaged, SizeIs(5));
    EXPECT_THAT(outcome.damaged[0], HasSubstr(files[0].string() + ": is incomplete"));
    EXPECT_THAT(outcome.damaged[4], HasSubstr(files[11].string() + ": is damaged"));
    EXPECT_THAT(outcome.missing_units, ElementsAre(1, 5, 6, 7, 12));
    EXPECT_EQ(outcome.counts.done, 21U);
    for (const std::uint32_t number : {1U, 5U, 6U, 7U, 12U}) {
        sweep.compute(folder / "units", number);
    }
    merged(folder / "anew", files);
    EXPECT_EQ(csv_texts(folder / "anew"), sweep.whole_csv(folder.path()));
}

TEST(Units, OfTwoPlansDoNotMix)
{
    const TemporaryFolder folder;
    const fs::path one = UnitSweep{}.compute(folder / "one", 1);
    UnitSweep of_other_scene;
    of_other_scene.plan = "00000000000000bb";
    of_other_scene.scene = "1111111111111111";
    const fs::path other = of_other_scene.compute(folder / "other", 2);
    const std::string scenes = refusal_of_merge(folder / "all", {one, other});
    EXPECT_THAT(scenes, HasSubstr("plan 00000000000000bb (gnomon Gnomon 0.1.0, scenes "
                                  "1111111111111111)"));
    EXPECT_THAT(scenes, HasSubstr("plan 00000000000000aa (gnomon Gnomon 0.1.0, scenes "
                                  "0123456789abcdef)"));
    UnitSweep of_other_version;
    of_other_version.plan = "00000000000000cc";
    of_other_version.gnomon = "Gnomon 0.2.0";
    const std::string versions =
        refusal_of_merge(folder / "all", {one, of_other_version.compute(folder / "version", 2)});
    EXPECT_THAT(versions, HasSubstr("(gnomon Gnomon 0.2.0,"));
    EXPECT_THAT(versions, HasSubstr("(gnomon Gnomon 0.1.0,"));
}

TEST(Units, AreSmallAndSayWhatTheyAre)
{
    const TemporaryFolder folder;
    const fs::path file = UnitSweep{}.compute(folder / "units", 5);
    const UnitSummary unit = read_unit_file(file);
    EXPECT_EQ(unit.mark, (UnitMark{"00000000000000aa", unit_name(5)}));
    EXPECT_EQ(unit.description.shard, (Shard{5, 12}));
    EXPECT_EQ(unit.outcome.done, 3U);
    EXPECT_THAT(unit.scenes, ElementsAre("0123456789abcdef"));
    // Most of the size is the schema's statements; the rest is three rows and a curve.
    EXPECT_LT(fs::file_size(file), 200U << 10U);
    EXPECT_THAT(unit_files(folder / "units"), ElementsAre(file));
}

TEST(Units, AreNotRunsAndRunsNotUnits)
{
    const TemporaryFolder folder;
    ExampleRun{2, 2}.compute(folder / "run");
    EXPECT_THAT(refusal_of_merge(folder / "all", {folder / "run" / "results.sqlite"}),
                HasSubstr("is not a file of `gnomon run-unit`"));
    fs::create_directories(folder / "nothing");
    EXPECT_THAT(refusal_of_merge(folder / "all", {folder / "nothing"}),
                HasSubstr("there is no results.sqlite"));
}

/// 5,000 units, 100 of them twice and 3 truncated. The test's results hold the duration.
TEST(LongUnits, OfThousandsAreUnitedButForThoseThatAreCutShort)
{
    const TemporaryFolder folder;
    UnitSweep sweep;
    sweep.units = 5'000;
    std::vector<fs::path> files = sweep.compute_all(folder / "units");
    for (std::uint32_t number = 1; number <= 100; ++number) {
        const fs::path copy = folder / fmt::format("copy{}.unit", number);
        fs::copy_file(files[49 * number], copy);
        files.push_back(copy);
    }
    for (const std::size_t cut : {10U, 2'000U, 4'999U}) {
        fs::resize_file(files[cut], fs::file_size(files[cut]) / 2);
    }
    std::shuffle(files.begin(), files.end(), std::mt19937{6});
    const auto begin = std::chrono::steady_clock::now();
    const MergeOutcome outcome = merged(folder / "all", files);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    RecordProperty("merge_s", fmt::format("{}", taken.count()));
    EXPECT_THAT(outcome.damaged, SizeIs(3));
    EXPECT_EQ(outcome.repeated, 100U);
    EXPECT_THAT(outcome.missing_units, ElementsAre(11, 2'001, 5'000));
    EXPECT_EQ(outcome.counts.done, 3U * 4'997U);
}

} // namespace
} // namespace gnomon::store
