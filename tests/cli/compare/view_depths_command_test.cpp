// Errors by view depth: what `gnomon compare --view-depths` writes.

#include "child_process.hpp"
#include "run_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;
using Rows = std::vector<std::map<std::string, std::string>>;

std::vector<std::string> comparison_with(const std::vector<std::string>& more)
{
    std::vector<std::string> arguments =
        small({"compare", "--builtin", "columns", "--json", "--set", "shadow_map.layout=cascades",
               "--set", "shadow_map.resolution=256"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// The numbers of a list, "[1, 2]".
std::vector<double> list(const std::string& text)
{
    return Json::parse(text).get<std::vector<double>>();
}

double sum(const Rows& rows, const std::string& column)
{
    double total = 0;
    for (const auto& row : rows) {
        total += std::stod(row.at(column));
    }
    return total;
}

TEST(ViewDepths, OfCascadesAddUpAndNameTheSlices)
{
    const TemporaryFolder folder;
    const std::string file = folder.path() / "cascades.csv";
    const Ending ending =
        gnomon(comparison_with({"--view-depths", file, "--view-depth-bands", "6"}));
    expect_done(ending);
    const Json result = Json::parse(ending.out);
    const Rows rows = csv_rows(file);
    ASSERT_EQ(rows.size(), 6U);
    for (const char* const name : {"false_shadow", "false_lit"}) {
        EXPECT_EQ(sum(rows, name), result.at(name).get<double>()) << name;
    }
    const auto edges_m = list(rows[0].at("slice_edges_m"));
    const auto texels_m = list(rows[0].at("slice_texels_m"));
    ASSERT_EQ(edges_m.size(), 5U);
    ASSERT_EQ(texels_m.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const Json& map = result.at("by_map")[i];
        EXPECT_EQ(edges_m[i], map.at("begin_m").get<double>());
        EXPECT_EQ(edges_m[i + 1], map.at("end_m").get<double>());
        EXPECT_EQ(texels_m[i], map.at("texel_m").get<double>());
    }
    // The nearest pixels read the first map, the farthest a later one.
    EXPECT_EQ(std::stof(rows.front().at("texel_m.min")), static_cast<float>(texels_m[0]));
    EXPECT_GT(std::stof(rows.back().at("texel_m.max")), static_cast<float>(texels_m[0]));
}

TEST(ViewDepths, HaveTheSameBandsForEveryMapOfACamera)
{
    const TemporaryFolder folder;
    const std::string cascades = folder.path() / "cascades.csv";
    const std::string single = folder.path() / "single.csv";
    expect_done(gnomon(comparison_with({"--view-depths", cascades})));
    expect_done(
        gnomon(comparison_with({"--view-depths", single, "--set", "shadow_map.layout=single"})));
    const Rows rows = csv_rows(cascades);
    const Rows others = csv_rows(single);
    ASSERT_EQ(rows.size(), 16U); // the default
    ASSERT_EQ(others.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const char* const column : {"lower_m", "upper_m", "lit", "blocked"}) {
            EXPECT_EQ(rows[i].at(column), others[i].at(column)) << i << ' ' << column;
        }
        EXPECT_EQ(others[i].at("slice_edges_m"), "");
    }
}

/// The error rates of a case of an example, by band.
std::vector<double> error_rates(const std::string& example, const std::string& name)
{
    const TemporaryFolder folder;
    const std::string file = folder.path() / "view_depths.csv";
    expect_done(gnomon({"compare", std::string{GNOMON_ROOT "/examples/"} + example, "--case", name,
                        "--view-depths", file, "--view-depth-bands", "5"}));
    std::vector<double> rates;
    for (const auto& row : csv_rows(file)) {
        rates.push_back(std::stod(row.at("error_rate")));
    }
    return rates;
}

TEST(CascadeExamples, OfColumnsAreBetterNearAndWorseFar)
{
    const auto cascades = error_rates("cascades_columns.toml", "cascades");
    const auto one_map = error_rates("cascades_columns.toml", "one_map");
    ASSERT_EQ(cascades.size(), 5U);
    ASSERT_EQ(one_map.size(), 5U);
    EXPECT_LT(cascades.front(), one_map.front() / 2);
    EXPECT_GT(cascades.back(), one_map.back() * 2);
}

TEST(CascadeExamples, OfTerrainAreWorseEverywhere)
{
    const auto cascades = error_rates("cascades_terrain.toml", "cascades");
    const auto one_map = error_rates("cascades_terrain.toml", "one_map");
    ASSERT_EQ(cascades.size(), 5U);
    ASSERT_EQ(one_map.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_GT(cascades[i], one_map[i]) << i;
    }
}

TEST(ViewDepths, RefuseBandsWithoutAFileAndTooMany)
{
    expect_refused(gnomon(comparison_with({"--view-depth-bands", "6"})), 2, "--view-depths");
    expect_refused(
        gnomon(comparison_with({"--view-depths", "/dev/null", "--view-depth-bands", "255"})), 2,
        "--view-depth-bands");
    expect_refused(gnomon(comparison_with({"--view-depths", "v.png"})), 2,
                   "v.png: a table is written as .csv; name it so");
}

} // namespace
} // namespace gnomon::testing
