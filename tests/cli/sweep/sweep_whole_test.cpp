// A sweep of 200,000 configurations, and the memory of sweeps.

#include "child_process.hpp"
#include "row_compared.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using ::testing::HasSubstr;

const std::string colonnade = R"(
scene.builtin = "columns"
image.width = 1280
image.height = 720
light.type = "spot"
light.position = [-14, 19, 10]
light.target = [0, 0, 0]
light.cone_deg = 60
[[case]]
name = "corner"
camera.eye = [11.5, 3.6, 11.5]
[[case]]
name = "front"
camera.eye = [2, 4, 16]
[sweep]
"bias.constant" = {from = 1e-7, to = 1e-2, count = 1000, scale = "log"}
"shadow_map.resolution" = [512, 1024, 2048, 4096, 8192]
"shadow_map.depth_format" = ["d16", "d24", "d32", "d32f"]
"shadow_map.near" = [0.1, 0.3, 0.6, 1, 2]
)";

/// The header and every n-th row of a CSV file without line ends in cells.
path every_row(const path& csv, int n)
{
    std::ifstream all{csv};
    path some = csv.parent_path() / "some.csv";
    std::ofstream out{some};
    std::string line;
    for (int i = 0; std::getline(all, line); ++i) {
        // Every thousandth row would have the same bias.
        if (i == 0 || (i - 1) % n == (i - 1) / n % n) {
            out << line << '\n';
        }
    }
    return some;
}

TEST(LongSweep, SharesItsWorkAndGivesWhatCompareGives)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", colonnade);
    const path run = folder.path() / "run";
    Start patient;
    patient.longest_s = 900;
    const Ending ending = swept(sweep(job, run, {"--quiet"}), patient);
    EXPECT_THAT(ending.out, HasSubstr("200,000 of 200,000 configurations done"));
    EXPECT_THAT(ending.out, HasSubstr("1 scene, 2 truths, 10 receiver passes, 100 shadow maps, "
                                      "200 lookup passes, 200 bias curves"));
    const auto rows = csv_rows(every_row(run / "results.csv", 1000));
    ASSERT_EQ(rows.size(), 200U);
    for (const auto& row : rows) {
        std::vector<std::string> compare{"compare", job, "--case", row.at("case"), "--json"};
        for (const std::string key : {"bias.constant", "shadow_map.resolution",
                                      "shadow_map.depth_format", "shadow_map.near"}) {
            compare.insert(compare.end(), {"--set", key + "=" + row.at(key)});
        }
        const Ending compared = gnomon(compare);
        SCOPED_TRACE(compared.command);
        ASSERT_EQ(compared.exit_code, 0) << compared.err;
        expect_row_compares(row, nlohmann::json::parse(compared.out));
    }
}

TEST(LongSweep, StaysBelowOneAndAHalfGibibytes)
{
    const TemporaryFolder folder;
    const path run = folder.path() / "run";
    // A million triangles; with software GL the textures are in the process's memory too.
    Start patient;
    patient.longest_s = 900;
    const Ending ending =
        swept({"sweep", "--builtin", "sphere-field", "--set", "image.width=1920", "--set",
               "image.height=1080", "--set", "shadow_map.resolution=8192", "--axis",
               "bias.constant={from=1e-6,to=1e-2,count=400,scale=\"log\"}", "--axis",
               "shadow_map.depth_format=d16,d24,d32f,u16", "--axis", "lookup.filter=nearest,pcf3",
               "--out", run, "--quiet"},
              patient);
    EXPECT_THAT(ending.out, HasSubstr("3,200 of 3,200 configurations done"));
    EXPECT_LT(ending.peak_memory_bytes, std::uint64_t{3} << 29U)
        << fmt::format("{:.0f} MiB", static_cast<double>(ending.peak_memory_bytes) / (1U << 20U));
}

} // namespace
} // namespace gnomon::testing
