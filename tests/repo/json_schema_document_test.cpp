#include "example_comparison.hpp"

#include "analysis/presets/engine_settings.hpp"
#include "analysis/presets/preset_result.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/json/methods_json.hpp"
#include "reports/json/presets_json.hpp"
#include "reports/text/engine_settings_text.hpp"
#include "scene/job/presets/presets.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace gnomon::reports {
namespace {

using Json = nlohmann::json;

const std::filesystem::path schema_document{GNOMON_ROOT "/docs/json_schema.md"};

std::string document_text(const std::filesystem::path& file)
{
    std::ifstream stream{file};
    return {std::istreambuf_iterator<char>{stream}, std::istreambuf_iterator<char>{}};
}

/// Whether a page names the member: by itself, linked or not, or as the path that metrics have.
bool is_named(const std::string& text, const std::string& name)
{
    return text.find(" `" + name + "`") != std::string::npos ||
           text.find(" [`" + name + "`](") != std::string::npos ||
           text.find("`" + name + ".") != std::string::npos;
}

TEST(JsonSchemaDocument, NamesEveryMemberOfTheObject)
{
    const std::string text =
        document_text(schema_document) +
        document_text(schema_document.parent_path() / "metrics.md"); // to which it refers
    const store::Example example;
    const Json json = Json::parse(comparison_json(example.comparison));
    ASSERT_GT(json.size(), 30U);
    for (const auto& [name, value] : json.items()) {
        EXPECT_TRUE(is_named(text, name)) << name << " is not in " << schema_document;
    }
}

TEST(JsonSchemaDocument, NamesTheMembersOfItsObjects)
{
    const std::string text = document_text(schema_document);
    const store::Example example;
    const Json json = Json::parse(comparison_json(example.comparison));
    for (const char* const object : {"environment", "seconds", "frustum", "truth_signs", "scene"}) {
        ASSERT_TRUE(json.at(object).is_object()) << object;
        for (const auto& [name, value] : json.at(object).items()) {
            EXPECT_TRUE(is_named(text, name)) << object << "." << name;
        }
    }
}

/// Calls `visit` with the name of each member, at any depth.
template <typename Visit>
void for_each_member(const Json& json, const Visit& visit)
{
    for (const auto& [name, value] : json.items()) {
        if (json.is_object()) {
            visit(name);
        }
        if (value.is_structured()) {
            for_each_member(value, visit);
        }
    }
}

TEST(JsonSchemaDocument, NamesTheMembersOfAPolygonOffset)
{
    const std::string text = document_text(schema_document);
    const store::Example example;
    analysis::Comparison comparison = example.comparison;
    comparison.drawn_offset.emplace();
    const Json json = Json::parse(comparison_json(comparison));
    EXPECT_TRUE(is_named(text, "polygon_offset"));
    for_each_member(json.at("polygon_offset"), [&](const std::string& name) {
        EXPECT_TRUE(is_named(text, name)) << "polygon_offset." << name;
    });
    EXPECT_FALSE(Json::parse(comparison_json(example.comparison)).contains("polygon_offset"));
}

TEST(JsonSchemaDocument, NamesTheMembersOfMethods)
{
    std::string text = document_text(schema_document);
    text.erase(0, text.find("\n## Methods\n"));
    const Json json = Json::parse(methods_json(methods::methods()));
    int members = 0;
    for_each_member(json, [&](const std::string& name) {
        EXPECT_TRUE(is_named(text, name)) << name << " is not in " << schema_document;
        ++members;
    });
    EXPECT_GT(members, 100);
}

/// The page from its section on presets on.
std::string text_on_presets()
{
    std::string text = document_text(schema_document);
    return text.erase(0, text.find("\n## Presets\n"));
}

TEST(JsonSchemaDocument, NamesTheMembersOfPresets)
{
    const std::string text = text_on_presets();
    const Json json = Json::parse(presets_json(scene::presets(*methods::key_table())));
    ASSERT_FALSE(json.empty());
    for (const auto& [name, value] : json.front().items()) {
        EXPECT_TRUE(is_named(text, name)) << name << " is not in " << schema_document;
    }
}

TEST(JsonSchemaDocument, NamesTheMembersOfEngineSettings)
{
    std::string text = document_text(schema_document);
    text.erase(0, text.find("\n## Engine settings\n"));
    const store::Example example;
    const scene::Preset three = scene::find_preset(*methods::key_table(), "three", "");
    const analysis::ReceiverBias receiver{.light_distance_m = 1, .texel_m = 1};
    const std::string json = engine_settings_json(
        {engine_settings(three, example.comparison.job, example.comparison.view, receiver)});
    int members = 0;
    for_each_member(Json::parse(json), [&](const std::string& name) {
        EXPECT_TRUE(is_named(text, name)) << name << " is not in " << schema_document;
        ++members;
    });
    EXPECT_GT(members, 20);
}

TEST(JsonSchemaDocument, NamesTheMembersOfAComparisonOfPresets)
{
    const std::string text = text_on_presets();
    const store::Example example;
    const std::vector<scene::Preset> presets = scene::presets(*methods::key_table());
    analysis::PresetComparison comparison;
    comparison.job = analysis::preset_result(example.comparison, nullptr);
    comparison.results = {analysis::preset_result(example.comparison, &presets.front())};
    comparison.skipped = {{&presets.back(), "not for this light"}};
    int members = 0;
    for_each_member(Json::parse(preset_comparison_json(comparison)), [&](const std::string& name) {
        EXPECT_TRUE(is_named(text, name)) << name << " is not in " << schema_document;
        ++members;
    });
    EXPECT_GT(members, 50);
}

TEST(JsonSchemaDocument, IsNotTakenToNameWhatItDoesNot)
{
    EXPECT_TRUE(is_named("| `seconds` | object |", "seconds"));
    EXPECT_TRUE(is_named("| `pixels.lit` |", "pixels"));
    EXPECT_FALSE(is_named("| `seconds` | object |", "second"));
}

} // namespace
} // namespace gnomon::reports
