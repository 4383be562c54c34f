// Sweeps of lights with several maps say of each configuration what a comparison says of it.

#include "child_process.hpp"
#include "row_compared.hpp"
#include "run_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;
using std::filesystem::path;
using Row = std::map<std::string, std::string>;
using Words = std::vector<std::string>;

const Words cascades{"--builtin", "columns",
                     "--set",     "shadow_map.layout=cascades",
                     "--set",     "shadow_map.resolution=64",
                     "--set",     "bias.slope=0.5"};
/// Runs a sweep into a folder.
void sweep_into(const path& run, const Words& job, const Words& more)
{
    swept(small(with(with({"sweep", "--out", run, "--quiet"}, job), more)));
}

/// What `gnomon compare` says of a row's configuration.
Json compared(const Words& job, const Row& row, const Words& keys)
{
    Words words{"compare", "--json"};
    words.insert(words.end(), job.begin(), job.end());
    for (const std::string& key : keys) {
        words.insert(words.end(), {"--set", key + "=" + row.at(key)});
    }
    const Ending ending = gnomon(small(words));
    expect_done(ending);
    return Json::parse(ending.out);
}

/// A bias in metres is another number in each cascade: its curve is not that of depth units.
TEST(SweepOfMetres, IsOfCascadesWhatComparisonsAre)
{
    const TemporaryFolder folder;
    const path run = folder.path() / "run";
    sweep_into(run, cascades, {"--axis", "bias.constant_m=0.01,0.05,0.3", "--no-keep-pixels"});
    for (const Row& row : csv_rows(run / "results.csv")) {
        expect_row_compares(row, compared(cascades, row, {"bias.constant_m"}));
    }
}

TEST(SweepOfMetres, HasACurveBesideThatOfDepthUnits)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", R"(
scene.builtin = "columns"
shadow_map.layout = "cascades"
shadow_map.resolution = 64
[[case]]
name = "metres"
bias.constant_m = 0.05
[[case]]
name = "depth units"
bias.constant = 0.003
)");
    const path run = folder.path() / "run";
    swept(small(sweep(job, run, {"--no-keep-pixels", "--quiet"})));
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_NE(rows[0].at("curve"), rows[1].at("curve"));
}

} // namespace
} // namespace gnomon::testing
