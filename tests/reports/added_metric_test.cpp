// A metric that is added to the table appears in every output. This program replaces
// analysis/results/metric_list.cpp by lists with one more metric.

#include "analysis/gate/gate_metrics.hpp"
#include "analysis/results/metric_table.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/page/report.hpp"
#include "reports/tables/comparison_table.hpp"
#include "reports/text/text.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/run/run_store.hpp"

#include "csv_table.hpp"
#include "example_comparison.hpp"
#include "example_run.hpp"
#include "page/example_page.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

namespace gnomon::analysis {

const CurveMetrics& map_metrics()
{
    static const CurveMetrics metrics = describe_map_metrics();
    return metrics;
}

const ConfigurationMetrics& configuration_metrics()
{
    static const ConfigurationMetrics metrics = [] {
        ConfigurationMetrics all = describe_configuration_metrics();
        MetricDescription added{"trial.wrong_twice", MetricType::count, "px", "trial", Worse::up};
        added.title = "wrong pixels, twice";
        added.table_note = "each of them twice";
        all.push_back({added, [](const ConfigurationResult& result) {
                           return MetricValue{
                               2 * (result.metrics.false_shadow + result.metrics.false_lit)};
                       }});
        return all;
    }();
    return metrics;
}

const CurveMetrics& curve_metrics()
{
    static const CurveMetrics metrics = describe_curve_metrics();
    return metrics;
}

const std::vector<MetricDescription>& metric_descriptions()
{
    static const std::vector<MetricDescription> descriptions{configuration_metrics().begin(),
                                                             configuration_metrics().end()};
    return descriptions;
}

} // namespace gnomon::analysis

namespace gnomon::reports {
namespace {

const std::string added = "trial.wrong_twice";

std::uint64_t wrong_twice(const analysis::Metrics& metrics)
{
    return 2 * (metrics.false_shadow + metrics.false_lit);
}

TEST(AddedMetric, IsInTheJsonOfAComparison)
{
    const auto json = nlohmann::json::parse(comparison_json(store::example().comparison));
    EXPECT_EQ(json.at("trial").at("wrong_twice"), wrong_twice(store::example().comparison.metrics));
}

TEST(AddedMetric, HasALineInTheTableOfAComparison)
{
    const analysis::Comparison& comparison = store::example().comparison;
    EXPECT_THAT(comparison_table(comparison),
                testing::ContainsRegex(fmt::format("trial.wrong-twice +{}  +each of them twice",
                                                   grouped(wrong_twice(comparison.metrics)))));
}

TEST(AddedMetric, IsAColumnOfTheResultsAndAMetricOfTheGate)
{
    const store::TemporaryFolder folder;
    const store::ExampleRun run;
    run.compute(folder.path());
    const std::uint64_t expected =
        wrong_twice(run.curve(0).rows.front().result.metrics); // of the first configuration
    const store::CsvTable results = store::read_csv(folder / "results.csv");
    EXPECT_EQ(results.rows.front().at(added), fmt::format("{}", expected));

    const analysis::GateMetric* const metric = analysis::find_gate_metric(added);
    ASSERT_NE(metric, nullptr);
    EXPECT_TRUE(metric->is_pixel_count);
    const store::GateRun read = store::read_gate_run(folder.path());
    EXPECT_TRUE(std::ranges::all_of(read.results.entries, [&](const analysis::GateEntry& entry) {
        return entry.metric(added) ==
               2 * (entry.metric("false_shadow").value() + entry.metric("false_lit").value());
    }));
}

TEST(AddedMetric, IsAColumnAndAChartOfThePage)
{
    const store::TemporaryFolder folder;
    const store::ExampleRun run;
    run.compute(folder.path());
    write_report({folder.path(), folder.path(), {}, "figures are not wanted", {}});
    const ReadPage page{store::read_text(folder / "report.html")};
    const auto& metrics = page.data().at("metrics");
    const auto described = std::ranges::find_if(
        metrics, [](const nlohmann::json& metric) { return metric.at("name") == added; });
    ASSERT_NE(described, metrics.end());
    EXPECT_EQ(described->at("title"), "wrong pixels, twice");
    const auto& columns = page.data().at("table").at("columns");
    EXPECT_TRUE(std::ranges::any_of(
        columns, [](const nlohmann::json& column) { return column.at("name") == added; }));
}

} // namespace
} // namespace gnomon::reports
