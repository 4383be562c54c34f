#include "analysis/gate/gate_metrics.hpp"
#include "reports/gate/baseline_table.hpp"
#include "scene/error.hpp"
#include "store/baseline/baseline.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/run/run_columns.hpp"

#include "example_comparison.hpp"
#include "example_run.hpp"
#include "lane.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::store {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using BaselineTree = nlohmann::ordered_json;

analysis::GateEntries example_results(const ExampleRun& run = {})
{
    const TemporaryFolder folder;
    run.compute(folder / "run");
    return read_gate_run(folder / "run").results;
}

/// The message for an invalid baseline; empty if the text is accepted.
std::string baseline_refusal(const std::string& text)
{
    try {
        (void)parse_baseline(text, "b.json");
    } catch (const scene::InputError& error) {
        return error.what();
    }
    return {};
}

TEST(Baseline, ReadsBackAsItWasWritten)
{
    const analysis::GateEntries run = example_results();
    const std::string text = baseline_json(run);
    const analysis::GateEntries back = parse_baseline(text, "b.json");
    ASSERT_EQ(back.entries.size(), 12U);
    EXPECT_EQ(back.axes, run.axes);
    EXPECT_EQ(back.environment.gnomon, run.environment.gnomon);
    for (std::size_t i = 0; i < run.entries.size(); ++i) {
        EXPECT_EQ(back.entries[i].key, run.entries[i].key) << i;
        EXPECT_EQ(back.entries[i].parameters, run.entries[i].parameters) << i;
        EXPECT_EQ(back.entries[i].metrics, run.entries[i].metrics) << i;
    }
    EXPECT_EQ(baseline_json(back), text);
}

TEST(Baseline, HoldsTheConstantKeysOnceAndTheAxesInTheKeyAlone)
{
    const auto json = BaselineTree::parse(baseline_json(example_results()));
    EXPECT_EQ(json.at("axes"), (BaselineTree{"bias.constant", "shadow_map.resolution"}));
    EXPECT_EQ(json.at("parameters").at("scene.builtin"), "wall");
    EXPECT_FALSE(json.at("parameters").contains("shadow_map.resolution"));
    for (const auto& entry : json.at("configurations")) {
        EXPECT_EQ(entry.at("case"), "noon");
        EXPECT_TRUE(entry.at("axes").contains("shadow_map.resolution"));
        EXPECT_TRUE(entry.at("parameters").empty()) << entry.at("parameters");
    }
}

TEST(Baseline, IsSortedByTheValuesOfTheAxes)
{
    analysis::GateEntries run;
    for (const char* const bias : {"10", "9", "1e-05"}) {
        run.entries.push_back({{"", {{"bias.constant", bias}}}, {}, {{"false_lit", 0}}});
    }
    run.axes = {"bias.constant"};
    EXPECT_FALSE(sort_entries(run));
    EXPECT_EQ(run.entries.front().key.axes.at("bias.constant"), "1e-05");
    EXPECT_EQ(run.entries.back().key.axes.at("bias.constant"), "10");
}

TEST(Baseline, KnowsEveryNumberOfTheResults)
{
    std::vector<std::string> columns;
    const auto add = [&](const auto& group) {
        for (const auto& column : group) {
            const bool is_judged = !column.name.ends_with(".allowance") &&
                                   !column.name.starts_with("bias_curve.recommended.") &&
                                   column.name != "bias_curve.peter_panning_free" &&
                                   column.name != "bias_curve.lit_at_zero";
            if (column.type != "TEXT" && is_judged) {
                columns.push_back(column.name);
            }
        }
    };
    add(map_columns());
    add(result_columns());
    add(bias_curve_columns());
    std::vector<std::string> metrics;
    for (const analysis::GateMetric& metric : analysis::result_metrics()) {
        metrics.emplace_back(metric.name);
    }
    EXPECT_EQ(metrics, columns);
}

TEST(Baseline, RefusesEveryTextThatIsCutShort)
{
    const std::string text = baseline_json(example_results({1, 1}));
    const std::size_t step = tests::in_lane<std::size_t>(5, 1);
    for (std::size_t length = 0; length + 2 < text.size(); length += step) {
        const std::string refusal = baseline_refusal(text.substr(0, length));
        ASSERT_THAT(refusal, AllOf(HasSubstr("b.json: "), Not(HasSubstr("\n")))) << length;
    }
}

TEST(Baseline, RefusesWhatWasEditedWrongly)
{
    struct Edit {
        const char* wanted; ///< of the message
        std::function<void(BaselineTree&)> apply;
    };
    const auto entry = [](BaselineTree& json) -> BaselineTree& {
        return json["configurations"][0];
    };
    const std::vector<Edit> edits{
        {"schema: is not 2", [](BaselineTree& json) { json["schema"] = 1; }},
        {"schema: is not 2", [](BaselineTree& json) { json["schema"] = "2"; }},
        {"lacks \"axes\"", [](BaselineTree& json) { json.erase("axes"); }},
        {"the file.more: the key is unknown", [](BaselineTree& json) { json["more"] = 1; }},
        {"environment.embree: must be a string",
         [](BaselineTree& json) { json["environment"]["embree"] = 3; }},
        {"environment: must be an object", [](BaselineTree& json) { json["environment"] = 3; }},
        {"axes: must be a list", [](BaselineTree& json) { json["axes"] = "bias.constant"; }},
        {"axes: names an unknown key",
         [](BaselineTree& json) {
             json["axes"] = {"a", "b"};
         }},
        {"parameters.x: is not a job key",
         [](BaselineTree& json) { json["parameters"]["x"] = "1"; }},
        {"with at least one", [](BaselineTree& json) { json["configurations"].clear(); }},
        {"must be a list of configurations",
         [](BaselineTree& json) { json["configurations"] = 7; }},
        {"two of them are noon",
         [](BaselineTree& json) {
             json["configurations"].push_back(BaselineTree(json["configurations"][0]));
         }},
        {"configurations[0].case: must be a string", [&](auto& json) { entry(json)["case"] = 1; }},
        {"are not those of \"axes\"",
         [&](auto& json) { entry(json)["axes"].erase("bias.constant"); }},
        {"also occurs in \"parameters\"",
         [&](auto& json) { entry(json)["parameters"]["scene.builtin"] = "wall"; }},
        {"is an axis", [&](auto& json) { entry(json)["parameters"]["bias.constant"] = "1"; }},
        {"must be an object with metrics", [&](auto& json) { entry(json)["metrics"].clear(); }},
        {"metrics.x: is not a metric", [&](auto& json) { entry(json)["metrics"]["x"] = 1; }},
        {"false_lit: must be a count",
         [&](auto& json) { entry(json)["metrics"]["false_lit"] = -1; }},
        {"false_lit: must be a count",
         [&](auto& json) { entry(json)["metrics"]["false_lit"] = 1.5; }},
        {"error_rate: must be a number",
         [&](auto& json) { entry(json)["metrics"]["error_rate"] = nullptr; }},
        {"false_lit: is too large",
         [&](auto& json) { entry(json)["metrics"]["false_lit"] = 18446744073709551615U; }}};
    const auto good = BaselineTree::parse(baseline_json(example_results({1, 2})));
    EXPECT_EQ(baseline_refusal(good.dump()), "");
    for (const Edit& edit : edits) {
        BaselineTree json = good;
        edit.apply(json);
        EXPECT_THAT(baseline_refusal(json.dump()),
                    AllOf(HasSubstr("b.json: "), HasSubstr(edit.wanted), Not(HasSubstr("\n"))));
    }
}

TEST(Baseline, RefusesHostileTexts)
{
    const std::string good = baseline_json(example_results({1, 1}));
    const auto with = [&](const std::string& old, const std::string& fresh) {
        std::string text = good;
        const std::size_t place = text.find(old);
        EXPECT_NE(place, std::string::npos) << old;
        return text.replace(place, old.size(), fresh);
    };
    EXPECT_THAT(baseline_refusal(with("\"false_lit\":", "\"false_lit\": 1, \"false_lit\":")),
                HasSubstr("false_lit: the key occurs twice"));
    EXPECT_THAT(baseline_refusal(with("\"schema\": 2", "\"schema\": 2, \"schema\": 2")),
                HasSubstr("schema: the key occurs twice"));
    EXPECT_THAT(baseline_refusal(with("\"error_rate\": ", "\"error_rate\": NaN, \"x\": ")),
                HasSubstr("not JSON"));
    EXPECT_THAT(baseline_refusal(with("\"error_rate\": ", "\"error_rate\": 1e999, \"x\": ")),
                HasSubstr("not JSON"));
    const std::string deep(1'000'000, '[');
    EXPECT_THAT(baseline_refusal(deep), HasSubstr("nests too deeply"));
    EXPECT_THAT(baseline_refusal(good + "{}"), HasSubstr("not JSON"));
    EXPECT_THAT(baseline_refusal(std::string(100, '\0')), HasSubstr("not JSON"));
    const std::string control = with("\"case\": \"noon\"", "\"case\": \"\\u001b[2J\\n\"");
    EXPECT_THAT(reports::baseline_table(parse_baseline(control, "b.json")), Not(HasSubstr("\x1b")));
}

TEST(Baseline, RefusesFilesThatAreNone)
{
    const TemporaryFolder folder;
    EXPECT_THROW((void)read_baseline(folder / "none.json"), BaselineMissing);
    EXPECT_THROW((void)read_baseline(folder / ""), scene::InputError);
    const std::filesystem::path large = folder / "large.json";
    std::ofstream{large}.close();
    std::filesystem::resize_file(large, most_baseline_bytes + 1);
    try {
        (void)read_baseline(large);
        ADD_FAILURE() << "it was read";
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("longer than 64 MiB"));
    }
}

TEST(BaselineDifference, NamesParametersBeforeMetrics)
{
    const analysis::GateEntries before = example_results({1, 2});
    analysis::GateEntries now = before;
    EXPECT_EQ(reports::baseline_difference(before, now),
              "0 of 2 configurations differ, 0 missing, 0 new\n");
    now.entries[1].parameters["bias.slope"] = "3";
    now.entries[1].metrics["false_lit"] += 1000;
    const std::string text = reports::baseline_difference(before, now);
    const std::size_t parameter = text.find("\n  bias.slope: ");
    const std::size_t metric = text.find("\n  false_lit ");
    EXPECT_LT(parameter, metric) << text;
    EXPECT_THAT(text, AllOf(HasSubstr("+1,000\n"), HasSubstr("1 of 2 configurations differ")));
}

} // namespace
} // namespace gnomon::store
