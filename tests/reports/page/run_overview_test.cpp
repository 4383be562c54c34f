// The head of a report: the best configurations, of which several may be equally good.

#include "reports/page/run_overview.hpp"

#include "example_comparison.hpp"
#include "example_run.hpp"
#include "store/run/run_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

using testing::ElementsAre;

/// Three maps at four biases. Only the last map's last bias has other errors.
std::vector<std::string> tied_settings(const std::filesystem::path& folder,
                                       const std::vector<std::uint64_t>& map_bytes)
{
    const store::ExampleRun run;
    std::filesystem::create_directories(folder);
    {
        store::RunStore store{folder, store::RunStore::Access::write};
        store.plan(run.description(), run.configurations());
        const analysis::Metrics same = run.curve(0).rows.front().result.metrics;
        const analysis::Metrics worse = run.curve(2).rows.back().result.metrics;
        for (std::uint64_t number = 0; number < run.curves; ++number) {
            analysis::FinishedCurve curve = run.curve(number);
            curve.curve.map_bytes = map_bytes.at(number);
            for (auto& row : curve.rows) {
                row.result.metrics = same;
            }
            if (number == 2) {
                curve.rows.back().result.metrics = worse;
            }
            store.record(curve);
        }
    }
    std::vector<std::string> settings;
    for (const OverviewRow& row : read_overview(store::RunReader{folder}).rows) {
        settings.push_back(row.settings);
    }
    return settings;
}

TEST(RunOverview, GroupsBiasesWithTheSameErrorsAndPrefersTheSmallerMap)
{
    const store::TemporaryFolder folder;
    EXPECT_THAT(tied_settings(folder / "run", {300, 100, 200}),
                ElementsAre("case = noon, shadow_map.resolution = 257, bias.constant = 1e-06 to "
                            "1.03e-06 (4 configurations)",
                            "case = noon, shadow_map.resolution = 258, bias.constant = 1e-06 to "
                            "1.02e-06 (3 configurations)",
                            "case = noon, shadow_map.resolution = 256, bias.constant = 1e-06 to "
                            "1.03e-06 (4 configurations)",
                            "case = noon, shadow_map.resolution = 258, bias.constant = 1.03e-06"));
}

TEST(RunOverview, NamesOneConfigurationOfTheBestInFull)
{
    const store::TemporaryFolder folder;
    (void)tied_settings(folder / "run", {300, 100, 200});
    const RunOverview overview = read_overview(store::RunReader{folder / "run"});
    ASSERT_TRUE(overview.headline);
    EXPECT_EQ(overview.headline->row, 4U);
    EXPECT_EQ(overview.headline->settings,
              "case = noon, shadow_map.resolution = 257, bias.constant = 1e-06");
}

/// A run of two cases, whose first has half the errors of the second.
RunOverview overview_of_cases(const std::filesystem::path& folder)
{
    const store::ExampleRun run{2, 2};
    std::filesystem::create_directories(folder);
    {
        store::RunStore store{folder, store::RunStore::Access::write};
        std::vector<analysis::Configuration> configurations = run.configurations();
        for (std::size_t i = 2; i < configurations.size(); ++i) {
            configurations[i].case_name = "it's dusk";
        }
        store.plan(run.description(), configurations);
        run.record(store);
    }
    return read_overview(store::RunReader{folder});
}

TEST(RunOverview, NeverRanksOneCaseAgainstAnother)
{
    const store::TemporaryFolder folder;
    const RunOverview overview = overview_of_cases(folder / "run");
    EXPECT_TRUE(overview.has_cases);
    ASSERT_EQ(overview.rows.size(), 2U);
    EXPECT_EQ(overview.rows[0].settings.find("case = noon, "), 0U) << overview.rows[0].settings;
    EXPECT_EQ(overview.rows[1].settings.find("case = it's dusk, "), 0U);
    ASSERT_TRUE(overview.headline);
    EXPECT_EQ(overview.headline->row, 0U);
    const auto is_of = [&](const char* start) {
        return std::ranges::count_if(overview.sentences, [&](const std::string& sentence) {
            return sentence.starts_with(start);
        });
    };
    EXPECT_EQ(is_of("Case noon: the best has "), 1);
    EXPECT_EQ(is_of("Case it's dusk: the best has "), 1);
    EXPECT_EQ(is_of("The best has") + is_of("The worst has"), 0);
}

} // namespace
} // namespace gnomon::reports
