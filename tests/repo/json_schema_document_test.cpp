#include "example_comparison.hpp"

#include "analysis/presets/engine_settings.hpp"
#include "analysis/presets/preset_result.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "reports/catalogue/catalogue.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/settings/settings_text.hpp"
#include "scene/job/presets/presets.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

using Json = nlohmann::json;

/// The document from a heading on.
std::string document_text(const std::string& heading = "")
{
    std::string text = store::read_text(GNOMON_ROOT "/docs/json_schema.md");
    return text.erase(0, heading.empty() ? 0 : text.find("\n## " + heading + "\n"));
}

/// Whether a page names the member: by itself, linked or not, or as the start of a metric's path.
bool is_named(const std::string& text, const std::string& name)
{
    return text.find(" `" + name + "`") != std::string::npos ||
           text.find(" [`" + name + "`](") != std::string::npos ||
           text.find("`" + name + ".") != std::string::npos;
}

void expect_named(const std::string& text, const Json& object)
{
    ASSERT_TRUE(object.is_object());
    for (const auto& [name, value] : object.items()) {
        EXPECT_TRUE(is_named(text, name)) << name << " is not in docs/json_schema.md";
    }
}

/// Expects the name of each member at any depth. Returns their number.
int expect_all_named(const std::string& text, const Json& json)
{
    int members = 0;
    for (const auto& [name, value] : json.items()) {
        if (json.is_object()) {
            EXPECT_TRUE(is_named(text, name)) << name << " is not in docs/json_schema.md";
            ++members;
        }
        if (value.is_structured()) {
            members += expect_all_named(text, value);
        }
    }
    return members;
}

TEST(JsonSchemaDocument, NamesEveryMemberOfTheObject)
{
    // The document refers to docs/metrics.md.
    const std::string text = document_text() + store::read_text(GNOMON_ROOT "/docs/metrics.md");
    const Json json = Json::parse(comparison_json(store::example().comparison));
    ASSERT_GT(json.size(), 30U);
    expect_named(text, json);
}

TEST(JsonSchemaDocument, NamesTheMembersOfItsObjects)
{
    const Json json = Json::parse(comparison_json(store::example().comparison));
    for (const char* const object : {"environment", "seconds", "frustum", "truth_signs", "scene"}) {
        SCOPED_TRACE(object);
        expect_named(document_text(), json.at(object));
    }
}

TEST(JsonSchemaDocument, NamesTheMembersOfAPolygonOffset)
{
    analysis::Comparison comparison = store::example().comparison;
    EXPECT_FALSE(Json::parse(comparison_json(comparison)).contains("polygon_offset"));
    comparison.drawn_offset.emplace();
    const Json json = Json::parse(comparison_json(comparison));
    EXPECT_TRUE(is_named(document_text(), "polygon_offset"));
    EXPECT_GT(expect_all_named(document_text(), json.at("polygon_offset")), 0);
}

TEST(JsonSchemaDocument, NamesTheMembersOfMethods)
{
    const Json json = Json::parse(methods_json(methods::methods()));
    EXPECT_GT(expect_all_named(document_text("Methods"), json), 100);
}

TEST(JsonSchemaDocument, NamesTheMembersOfPresets)
{
    const Json json = Json::parse(presets_json(scene::presets(*methods::key_table())));
    ASSERT_FALSE(json.empty());
    expect_named(document_text("Presets"), json.front());
}

TEST(JsonSchemaDocument, NamesTheMembersOfEngineSettings)
{
    const analysis::Comparison& comparison = store::example().comparison;
    const scene::Preset three = scene::find_preset(*methods::key_table(), "three", "");
    const TranslatedSettings of_engine{
        analysis::engine_settings(three, comparison.job, comparison.view, {.light_distance_m = 1}),
        "1a2b", "sun"};
    const TranslatedSettings of_language{GraphicsSettings{}};
    const Json json = Json::parse(settings_json(std::array{of_engine, of_language}));
    EXPECT_GT(expect_all_named(document_text("Engine settings"), json), 30);
}

TEST(JsonSchemaDocument, NamesTheMembersOfAComparisonOfPresets)
{
    const std::vector<scene::Preset> presets = scene::presets(*methods::key_table());
    analysis::PresetComparison comparison;
    comparison.job = analysis::preset_result(store::example().comparison, nullptr);
    comparison.results = {analysis::preset_result(store::example().comparison, &presets.front())};
    comparison.skipped = {{&presets.back(), "not for this light"}};
    const Json json = Json::parse(preset_comparison_json(comparison));
    EXPECT_GT(expect_all_named(document_text("Presets"), json), 50);
}

TEST(JsonSchemaDocument, IsNotTakenToNameWhatItDoesNot)
{
    EXPECT_TRUE(is_named("| `seconds` | object |", "seconds"));
    EXPECT_TRUE(is_named("| `pixels.lit` |", "pixels"));
    EXPECT_FALSE(is_named("| `seconds` | object |", "second"));
}

} // namespace
} // namespace gnomon::reports
