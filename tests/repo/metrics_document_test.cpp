#include "analysis/results/metric_table.hpp"
#include "generated_document.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>

namespace gnomon::analysis {
namespace {

std::string_view type_name(MetricType type)
{
    switch (type) {
    case MetricType::count:
        return "integer";
    case MetricType::number:
        return "real";
    case MetricType::flag:
        return "boolean";
    }
    return "";
}

std::string_view worse_name(const std::optional<Worse>& worse)
{
    if (!worse) {
        return "–";
    }
    switch (*worse) {
    case Worse::up:
        return "more";
    case Worse::down:
        return "less";
    case Worse::both:
        return "either";
    }
    return "";
}

template <typename Metrics>
std::string section(std::string_view heading, std::string_view words, const Metrics& metrics)
{
    std::string text = fmt::format(
        "\n## {}\n\n{}\n\n| metric | type | unit | worse | meaning |\n|---|---|---|---|---|\n",
        heading, words);
    for (const MetricDescription& metric : metrics) {
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", metric.name, type_name(metric.type),
                            metric.unit, worse_name(metric.worse), metric.meaning);
    }
    return text;
}

std::string document()
{
    return R"(# Metrics

Every number that is measured of a configuration. Its name is its path in what `gnomon compare --json`
[prints](json_schema.md), joined with dots: `pixels.lit` is `pixels` → `lit`; members of an array are counted
from 0, and the two ends of an interval are `lo` and `hi`. It is the name of a column of
[results.csv](csv_schema.md) and of what a rule of the [gate](gate.md#metrics) is about; *worse* is the change
that a rule guards against unless it says otherwise (–: no rule can be about it). A value that does not exist
is `null`, and an empty cell: a rate without a denominator, a limit that is infinite. Real numbers without a
unit are shares.
)" + section("The map", "As fitted; not in the JSON, where `frustum` says more.", map_metrics()) +
           section("The pixels", "With the configuration's own bias.", configuration_metrics()) +
           section("The bias curve", "Of all constant biases at once.", curve_metrics());
}

TEST(MetricsDocument, IsTheTable)
{
    tests::expect_document(GNOMON_ROOT "/docs/metrics.md", document(), "analysis_tests");
}

} // namespace
} // namespace gnomon::analysis
