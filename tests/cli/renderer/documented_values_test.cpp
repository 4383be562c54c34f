#include "cli/tune/documented_values.hpp"
#include "scene/error.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

using scene::LightType;

const std::vector<EngineKey> keys{
    {"bias", scene::RealDomain{.lower = -1, .upper = 1}, 0.0, "", "a number"},
    {"soft", scene::FlagDomain{}, false, "", "a flag"}};

EngineValues read(const std::string& text, LightType light)
{
    const std::filesystem::path file = testing::TempDir() + "gnomon_documented_values.toml";
    std::ofstream{file} << text;
    EngineValues values;
    try {
        values = documented_values(file, light, keys);
    } catch (...) {
        std::filesystem::remove(file);
        throw;
    }
    std::filesystem::remove(file);
    return values;
}

TEST(DocumentedValues, AreThoseOfAllLightsAndOverThemOfTheOne)
{
    const std::string text = "title = \"an engine\"\n[documented]\nsource = \"its manual\"\n"
                             "engine = { bias = -0.5, soft = true }\npoint = { bias = 0.25 }\n";
    EXPECT_EQ(read(text, LightType::spot), (EngineValues{{"bias", -0.5}, {"soft", true}}));
    EXPECT_EQ(read(text, LightType::point), (EngineValues{{"bias", 0.25}, {"soft", true}}));
}

TEST(DocumentedValues, AreNoneWithoutATableOrAFile)
{
    EXPECT_TRUE(read("title = \"an engine\"\n", LightType::spot).empty());
    EXPECT_TRUE(documented_values({}, LightType::spot, keys).empty());
    EXPECT_TRUE(documented_values("/no/such/league.toml", LightType::spot, keys).empty());
}

TEST(DocumentedValues, RefuseWhatTheEngineDoesNotTake)
{
    EXPECT_THROW((void)read("[documented]\nengine = { bias = 7 }\n", LightType::spot),
                 scene::InputError);
    EXPECT_THROW((void)read("[documented]\nengine = { depth = 0 }\n", LightType::spot),
                 scene::InputError);
}

} // namespace
} // namespace gnomon::cli
