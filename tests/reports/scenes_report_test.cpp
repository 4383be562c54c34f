#include "reports/json/scenes_json.hpp"
#include "reports/tables/scenes_table.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <vector>

namespace gnomon::reports {
namespace {

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
