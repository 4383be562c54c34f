// The sweep files in examples/sweeps do what their comments say.

#include "child_process.hpp"
#include "lane.hpp"
#include "run_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;

const path examples = path{GNOMON_ROOT} / "examples" / "sweeps";

/// Runs the file, in the usual lane with a smaller image, and returns its rows, all of which are
/// done.
auto example_rows(const std::string& name)
{
    const TemporaryFolder folder;
    const path run = folder.path() / "run";
    swept(sweep(examples / name, run,
                tests::in_lane<std::vector<std::string>>(
                    {"--set", "image.width=160", "--set", "image.height=90"}, {})));
    auto rows = csv_rows(run / "results.csv");
    for (const auto& row : rows) {
        EXPECT_EQ(row.at("status"), "done") << row.at("message");
    }
    return rows;
}

TEST(SweepExamples, HaveOneForEachFile)
{
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator{examples}) {
        files.insert(entry.path().filename().string());
    }
    EXPECT_EQ(files, (std::set<std::string>{"bias.toml", "depth_bits.toml", "near_far.toml",
                                            "resolution.toml"}));
}

TEST(SweepExamples, BiasTradesAcneForPeterPanning)
{
    const auto rows = example_rows("bias.toml");
    ASSERT_EQ(rows.size(), 400U); // two cameras
    EXPECT_GT(std::stoul(rows[0].at("labels.acne")), std::stoul(rows[199].at("labels.acne")));
    EXPECT_LT(std::stoul(rows[0].at("labels.peter_panning")),
              std::stoul(rows[199].at("labels.peter_panning")));
}

TEST(SweepExamples, ResolutionLeavesFewerErrors)
{
    const auto rows = example_rows("resolution.toml");
    ASSERT_EQ(rows.size(), 375U);
    const auto best = [&](std::size_t row) {
        return std::stoul(rows[row].at("bias_curve.best_errors"));
    };
    EXPECT_GT(best(0), 4 * best(300)) << "nearest, 256 and 4096 texels";
}

TEST(SweepExamples, DepthBitsEndPrecisionErrors)
{
    const auto rows = example_rows("depth_bits.toml");
    ASSERT_EQ(rows.size(), 488U);
    std::size_t u8 = 0;
    std::size_t d32f = 0;
    for (const auto& row : rows) {
        const std::size_t errors = std::stoul(row.at("causes.precision"));
        u8 += row.at("shadow_map.depth_format") == "u8" ? errors : 0;
        d32f += row.at("shadow_map.depth_format") == "d32f" ? errors : 0;
    }
    EXPECT_GT(u8, 100 * (d32f + 1));
}

TEST(SweepExamples, ACarelessRangeSpendsPrecisionNearTheLight)
{
    const auto rows = example_rows("near_far.toml");
    ASSERT_EQ(rows.size(), 6U);
    for (std::size_t i = 1; i < 5; ++i) {
        EXPECT_GT(std::stoul(rows[i].at("causes.precision")),
                  std::stoul(rows[i - 1].at("causes.precision")));
    }
}

} // namespace
} // namespace gnomon::testing
