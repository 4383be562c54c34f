// What `gnomon sweep` says that it found.

#include "child_process.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(SweepAnswer, HasTheBestAndTheWorstOfEachCase)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path run = folder.path() / "run";
    const Ending ending = swept(sweep(job, run, {"--axis", "bias.constant=0,0.01"}));
    for (const char* const name : {"sun", "spot"}) {
        EXPECT_THAT(ending.out, ContainsRegex(fmt::format("\n  best: [0-9.]+ % wrong \\([0-9,]+ px "
                                                          "false shadow, [0-9,]+ px false lit\\), "
                                                          "case = {}, bias.constant = ",
                                                          name)));
        EXPECT_THAT(ending.out, ContainsRegex(fmt::format("\n  worst: .*, case = {}, ", name)));
    }
    EXPECT_THAT(
        ending.out,
        EndsWith(fmt::format("`gnomon report {}` makes a page of all of them.\n", run.string())));
    EXPECT_LE(std::count(ending.out.begin(), ending.out.end(), '\n'), 12);
}

TEST(SweepAnswer, HasOneLineWhereAllAreEquallyGood)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const Ending ending =
        swept(sweep(job, folder.path() / "run", {"--axis", "bias.constant=0", "--case", "sun"}));
    EXPECT_THAT(ending.out, AllOf(HasSubstr("\n  all: "), Not(HasSubstr("worst: "))));
}

} // namespace
} // namespace gnomon::testing
