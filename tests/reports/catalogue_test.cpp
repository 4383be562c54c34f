#include "methods/list.hpp"
#include "reports/catalogue/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

using Json = nlohmann::json;
using methods::Compares;
using methods::Curve;
using methods::Monotone;
using methods::Verdict;
using scene::Filter;
using ::testing::HasSubstr;

constexpr std::array<std::string_view, 1> bias_key{"bias.normal_texels"};
constexpr std::array<std::string_view, 1> lookup_table{"lookup"};
constexpr auto made_up_sources = std::to_array<methods::Source>(
    {{"A. Author", 1999, "A title", {}}, {"B. Author", 2001, "Means", "filters"}});
constexpr auto made_up_filters = std::to_array<methods::FilterChoice>(
    {{Filter::nearest, "one texel"}, {Filter::pcf3, "nine texels"}});
constexpr auto made_up_terms = std::to_array<methods::BiasTerm>(
    {{"offset", bias_key, methods::BiasPlace::lookup_position, "moves P"}});

methods::LookupTraits made_up_traits(const scene::Job& job)
{
    if (job.lookup.filter == Filter::nearest) {
        return {};
    }
    return {.verdict = Verdict::fraction,
            .compares = Compares::none,
            .monotonicity = {Monotone::up_to_rounding, 0.125},
            .curve = Curve::by_bisection,
            .width_texels = 3,
            .map_bytes = 4096,
            .has_map = false};
}

methods::Method made_up()
{
    return {.name = "made-up",
            .sentence = "looks at texels",
            .sources = made_up_sources,
            .page = "made_up.md",
            .key_tables = lookup_table,
            .filters = made_up_filters,
            .bias_terms = made_up_terms,
            .traits = made_up_traits};
}

methods::Method without_filters()
{
    methods::Method method = made_up();
    method.name = "plain";
    method.sources = {};
    method.key_tables = {};
    method.filters = {};
    method.bias_terms = {};
    return method;
}

TEST(MethodsJson, SaysWhatAMethodIsAndWhereItIsFrom)
{
    const auto json = Json::parse(methods_json(std::vector{made_up()}));
    ASSERT_EQ(json.size(), 1U);
    EXPECT_EQ(json[0]["name"], "made-up");
    EXPECT_EQ(json[0]["sentence"], "looks at texels");
    EXPECT_EQ(json[0]["page"], "made_up.md");
    EXPECT_EQ(json[0]["sources"], Json::parse(R"([
        {"authors": "A. Author", "year": 1999, "title": "A title", "about": ""},
        {"authors": "B. Author", "year": 2001, "title": "Means", "about": "filters"}])"));
}

TEST(MethodsJson, SaysWhatIsPromisedWithEachFilter)
{
    const auto json = Json::parse(methods_json(std::vector{made_up()}));
    const Json with_nearest = Json::parse(R"({"verdict": "binary", "compares": "each_tap",
        "rises": "exactly", "largest_fall": null, "curve": "by_formula",
        "footprint_texels": 1, "reads": "footprint", "samples": 1, "map_bytes": 0, "has_map": true})");
    EXPECT_EQ(json[0]["lookup_traits"], with_nearest);
    EXPECT_EQ(json[0]["promises"], with_nearest);
    ASSERT_EQ(json[0]["filters"].size(), 2U);
    EXPECT_EQ(json[0]["filters"][0]["promises"], with_nearest);
    const Json with_pcf3 = Json::parse(R"({"verdict": "fraction", "compares": "none",
        "rises": "up_to_rounding", "largest_fall": 0.125, "curve": "by_bisection",
        "footprint_texels": 3, "reads": "footprint", "samples": 1, "map_bytes": 4096, "has_map": false})");
    EXPECT_EQ(json[0]["filters"][1], Json({{"name", "pcf3"},
                                           {"sentence", "nine texels"},
                                           {"width_texels", 3},
                                           {"lookup_traits", with_pcf3},
                                           {"promises", with_pcf3}}));
}

TEST(MethodsJson, TakesUnitsDefaultsAndStagesFromTheKeyTable)
{
    const auto json = Json::parse(methods_json(std::vector{made_up()}));
    EXPECT_EQ(json[0]["bias_terms"], Json::parse(R"([{"name": "offset", "sentence": "moves P",
        "acts": "lookup_position", "refused": false, "stages": ["lookup"],
        "keys": [{"name": "bias.normal_texels", "unit": "texel widths"}]}])"));
    ASSERT_EQ(json[0]["keys"].size(), 3U);
    EXPECT_EQ(json[0]["keys"][1], Json::parse(R"({"name": "lookup.outside",
        "description": "the verdict beyond the map's edge or its far plane", "unit": "",
        "default": "lit", "allowed": "one of lit, shadowed, clamp", "stages": ["lookup"]})"));
}

TEST(MethodsJson, GivesDefaultsOfEveryTypeAsValues)
{
    const auto json = Json::parse(methods_json(methods::methods()));
    for (const Json& key : json[0]["keys"]) {
        const std::string name = key["name"];
        if (name == "shadow_map.resolution") {
            EXPECT_EQ(key["default"], 1024);
            EXPECT_EQ(key["unit"], "texels");
        } else if (name == "shadow_map.reversed") {
            EXPECT_EQ(key["default"], false);
        } else if (name == "shadow_map.near") {
            EXPECT_EQ(key["default"], "auto");
            EXPECT_EQ(key["stages"], Json::parse(R"(["receivers", "shadow_map"])"));
        } else if (name == "bias.constant_m") {
            EXPECT_EQ(key["default"], nullptr);
        }
    }
}

TEST(MethodsJson, ListsWhatIsNotThereAsEmptyArrays)
{
    EXPECT_EQ(methods_json({}), "[]\n");
    const auto json = Json::parse(methods_json(std::vector{without_filters()}));
    for (const char* const member : {"sources", "filters", "bias_terms", "keys"}) {
        EXPECT_EQ(json[0][member], Json::array()) << member;
    }
    EXPECT_EQ(json[0]["promises"]["curve"], "by_formula");
}

TEST(MethodsTable, AlignsFiltersBiasTermsAndKeys)
{
    EXPECT_EQ(methods_table(std::vector{made_up()}),
              "made-up: looks at texels\n"
              "\n"
              "  source  A. Author, 1999, A title\n"
              "  source  B. Author, 2001, Means: filters\n"
              "  page    made_up.md\n"
              "\n"
              "  filter   texels  verdict   compares  rises                  curve\n"
              "  nearest  1 × 1   binary    each tap  exactly                by formula    "
              "one texel\n"
              "  pcf3     3 × 3   fraction  none      up to rounding (0.12)  by bisection  "
              "nine texels\n"
              "\n"
              "  bias term  acts on          stage   keys\n"
              "  offset     lookup position  lookup  bias.normal_texels [texel widths]  moves P\n"
              "\n"
              "  key              default\n"
              "  lookup.filter    \"nearest\"  how the map is filtered\n"
              "  lookup.outside   \"lit\"      the verdict beyond the map's edge or its far plane\n"
              "  lookup.position  \"vertex\"   where a receiver's light clip position is computed: "
              "at the "
              "vertices, and interpolated, or at each pixel from its world position, which "
              "several maps need\n");
}

TEST(MethodsTable, LeavesOutWhatAMethodDoesNotHave)
{
    const std::string table = methods_table(std::vector{without_filters()});
    EXPECT_EQ(table, "plain: looks at texels\n"
                     "\n"
                     "  page    made_up.md\n"
                     "\n"
                     "  texels  verdict  compares  rises    curve\n"
                     "  1 × 1   binary   each tap  exactly  by formula\n");
    EXPECT_EQ(methods_table({}), "");
}

TEST(MethodsTable, ShowsEveryMethodAndFilterThereIs)
{
    const std::string table = methods_table(methods::methods());
    for (const methods::Method& method : methods::methods()) {
        EXPECT_THAT(table, HasSubstr(std::string{method.name} + ": "));
        for (const methods::FilterChoice& filter : method.filters) {
            EXPECT_THAT(table, HasSubstr(std::string{scene::filter_name(filter.filter)} + " "));
        }
    }
}

std::vector<scene::BuiltinScene> two_scenes()
{
    scene::BuiltinScene wall{"wall", "An upright sheet on flat ground", "closed form", {}, nullptr,
                             nullptr};
    wall.parameters = {
        {"thickness_m", "Thickness of the wall", "m", 0.25, 0, 10, false, {}},
        {"count", "How many walls", "", 3.0, 1, 64, true, {}},
        {"style", "What it is built of", "", "brick", 0, 0, false, {"brick", "sheet"}},
    };
    return {wall, {"yard", "Objects on ground", "lesson", {}, nullptr, nullptr}};
}

TEST(ScenesJson, ListsEveryParameterWithUnitDefaultAndRange)
{
    const auto scenes = two_scenes();
    const auto json = nlohmann::json::parse(scenes_json(scenes));
    ASSERT_EQ(json.size(), 2U);
    EXPECT_EQ(json[0]["name"], "wall");
    EXPECT_EQ(json[0]["description"], "An upright sheet on flat ground");
    EXPECT_EQ(json[0]["origin"], "closed form");
    const auto& parameters = json[0]["parameters"];
    ASSERT_EQ(parameters.size(), 3U);
    EXPECT_EQ(parameters[0], nlohmann::json::parse(R"({"name": "thickness_m",
        "description": "Thickness of the wall", "unit": "m", "type": "number", "default": 0.25,
        "range": [0.0, 10.0]})"));
    EXPECT_EQ(parameters[1], nlohmann::json::parse(R"({"name": "count",
        "description": "How many walls", "unit": "", "type": "integer", "default": 3,
        "range": [1, 64]})"));
    EXPECT_TRUE(parameters[1]["default"].is_number_integer());
    EXPECT_EQ(parameters[2], nlohmann::json::parse(R"({"name": "style",
        "description": "What it is built of", "unit": "", "type": "word", "default": "brick",
        "words": ["brick", "sheet"]})"));
    EXPECT_EQ(json[1]["parameters"], nlohmann::json::array());
}

TEST(ScenesJson, ListsNoScenesAsAnEmptyArray)
{
    EXPECT_EQ(scenes_json({}), "[]\n");
}

TEST(ScenesTable, AlignsNamesAndParameters)
{
    const auto scenes = two_scenes();
    EXPECT_EQ(scenes_table(scenes),
              "wall           An upright sheet on flat ground\n"
              "  thickness_m  Thickness of the wall (default 0.25; 0 to 10 m)\n"
              "  count        How many walls (default 3; 1 to 64)\n"
              "  style        What it is built of (default brick; brick | sheet)\n"
              "yard           Objects on ground\n");
}

} // namespace
} // namespace gnomon::reports
