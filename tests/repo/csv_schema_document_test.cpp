#include "example_comparison.hpp"
#include "example_run.hpp"

#include "analysis/results/metric_table.hpp"
#include "csv_table.hpp"
#include "methods/key_table.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/csv/view_depth_csv.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

/// The columns that a row "…" stands for, by the page to which it refers.
std::vector<std::string> columns_elsewhere(const std::string& row)
{
    std::vector<std::string> columns;
    const auto add = [&](const auto& metrics) {
        for (const analysis::MetricDescription& metric : metrics) {
            columns.push_back(metric.name);
        }
    };
    if (row.find("metrics.md#the-map") != std::string::npos) {
        add(analysis::map_metrics());
    } else if (row.find("metrics.md#the-pixels") != std::string::npos) {
        add(analysis::configuration_metrics());
    } else if (row.find("metrics.md#the-bias-curve") != std::string::npos) {
        add(analysis::curve_metrics());
    } else if (row.find("(job_file.md)") != std::string::npos) {
        for (const scene::Key& key : methods::key_table()->rows()) {
            columns.push_back(key.name);
        }
    }
    return columns;
}

/// The columns that a section of the document describes, in its order.
std::vector<std::string> documented_columns(const std::string& section)
{
    std::ifstream document{GNOMON_ROOT "/docs/csv_schema.md"};
    std::vector<std::string> columns;
    bool is_inside = false;
    for (std::string line; std::getline(document, line);) {
        if (line.starts_with("## ")) {
            is_inside = line == "## " + section;
        } else if (is_inside && line.starts_with("| `")) {
            columns.push_back(line.substr(3, line.find('`', 3) - 3));
        } else if (is_inside && line.starts_with("| … |")) {
            const std::vector<std::string> elsewhere = columns_elsewhere(line);
            columns.insert(columns.end(), elsewhere.begin(), elsewhere.end());
        }
    }
    return columns;
}

TEST(CsvSchemaDocument, DescribesEveryColumnInItsOrder)
{
    const store::TemporaryFolder folder;
    store::ExampleRun{1, 1, 1, 2}.compute(folder.path());
    for (const char* const file :
         {"results.csv", "error_vs_z.csv", "bias_curves.csv", "by_map.csv"}) {
        EXPECT_EQ(documented_columns(file), store::read_csv(folder / file).columns) << file;
    }
}

TEST(CsvSchemaDocument, DescribesErrorsByViewDepth)
{
    const std::string text = store::view_depth_csv(store::example().comparison, 2);
    EXPECT_EQ(documented_columns("Errors by view depth"), store::parse_csv(text).columns);
}

TEST(CsvSchemaDocument, SpeaksOfTheSchemaThatIsWritten)
{
    const store::TemporaryFolder folder;
    store::ExampleRun{1, 1}.compute(folder.path());
    EXPECT_EQ(store::read_csv(folder / "results.csv").rows.at(0).at("schema"), "2");
    EXPECT_NE(store::read_text(GNOMON_ROOT "/docs/csv_schema.md").find("a `schema`, which is 2"),
              std::string::npos);
}

} // namespace
} // namespace gnomon::reports
