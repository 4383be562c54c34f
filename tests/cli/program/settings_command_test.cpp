// `gnomon settings`: what to type in an engine.

#include "child_process.hpp"
#include "run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

Ending settings(std::vector<std::string> arguments)
{
    const std::vector<std::string> small{"--set", "image.width=96", "--set", "image.height=54"};
    arguments.insert(arguments.begin(), "settings");
    arguments.insert(arguments.end(), small.begin(), small.end());
    return gnomon(arguments);
}

Json settings_json(std::vector<std::string> arguments)
{
    arguments.emplace_back("--json");
    const Ending ending = settings(std::move(arguments));
    expect_done(ending);
    return Json::parse(ending.out);
}

/// The value of a setting of the first light.
Json value_of(const Json& lights, const std::string& name)
{
    for (const Json& setting : lights.at(0).at("settings")) {
        if (setting.at("name") == name) {
            return setting.at("value");
        }
    }
    ADD_FAILURE() << "no setting " << name;
    return nullptr;
}

TEST(SettingsCommand, PrintsLinesToPasteWithTheirUnits)
{
    const Ending ending = settings(
        {"--builtin", "yard", "--engine", "three", "--own", "--set", "bias.constant_m=0.1"});
    expect_done(ending);
    // The yard's map reaches from 0.01 m to 100 m.
    EXPECT_THAT(ending.out,
                AllOf(HasSubstr("  light.shadow.mapSize.set(1024, 1024);\n"),
                      HasSubstr("  light.shadow.bias = -0.001;"),
                      HasSubstr("// against acne it is negative; 0.1 m\n"),
                      HasSubstr("The map spans 40 m x 40 m, and 100 m along the light;"),
                      HasSubstr("three.js has no setting for lookup.filter = \"pcf3\""),
                      HasSubstr("its settings: https://threejs.org/")));
}

TEST(SettingsCommand, TakesTheRecommendedBiasUnlessTheOwnIsAskedFor)
{
    const std::vector<std::string> job{"--builtin", "yard",  "--engine",
                                       "bevy",      "--set", "bias.constant_m=0.0"};
    std::vector<std::string> own = job;
    own.emplace_back("--own");
    const std::string name = "DirectionalLight::shadow_depth_bias";
    const Json recommended = settings_json(job);
    EXPECT_TRUE(recommended.at(0).at("recommended"));
    EXPECT_GT(value_of(recommended, name), 0);
    const Json own_bias = settings_json(own);
    EXPECT_FALSE(own_bias.at(0).at("recommended"));
    EXPECT_EQ(value_of(own_bias, name), 0);
    EXPECT_LT(recommended.at(0).at("false_shadow_rate"), own_bias.at(0).at("false_shadow_rate"));
}

TEST(SettingsCommand, SaysWhereLengthsHoldUnderASpot)
{
    const Ending ending = settings({"--builtin", "sphere-plane", "--engine", "three"});
    expect_done(ending);
    EXPECT_THAT(ending.out, AllOf(HasSubstr("  light.shadow.camera.near = 0.5;\n"),
                                  HasSubstr("Lengths hold 4.9"),
                                  HasSubstr(" m from the light, where the map is ")));
}

TEST(SettingsCommand, PromisesNoErrorsWhereTheEngineLacksABias)
{
    const Json lights = settings_json({"--builtin", "sphere-plane", "--engine", "openscenegraph"});
    EXPECT_TRUE(lights.at(0).at("false_shadow_rate").is_null());
    EXPECT_FALSE(lights.at(0).at("cannot").empty());
}

TEST(SettingsCommand, NamesLightsThatTheEngineDoesNotSupport)
{
    const TemporaryFolder folder;
    const auto job = folder.write("job.toml", R"(scene.builtin = "yard"
[[lights]]
name = "sun"
type = "directional"
direction = [0.4, -1, 0.3]
[[lights]]
name = "lamp"
type = "spot"
position = [0, 6, 0]
target = [0, 0, 0]
cone_deg = 60
)");
    for (const bool json : {false, true}) {
        std::vector<std::string> arguments{job, "--engine", "bevy"};
        if (json) {
            arguments.emplace_back("--json");
        }
        const Ending ending = settings(arguments);
        EXPECT_EQ(ending.exit_code, 0);
        EXPECT_THAT(ending.out, HasSubstr(json ? "\"light\": \"sun\"" : "Bevy, light sun, with "));
        EXPECT_EQ(ending.err, "gnomon settings: note: light lamp: Bevy: Gnomon does not know its "
                              "settings for a spot light\n");
    }
    expect_refused(settings({job, "--engine", "playcanvas", "--light", "sun"}), 2,
                   "PlayCanvas: Gnomon does not know its settings for a directional light");
}

TEST(SettingsCommand, RefusesUnknownEnginesAndOtherLights)
{
    expect_refused(settings({"--builtin", "yard", "--engine", "thre"}), 2,
                   "--engine thre: unknown engine; the nearest is three");
    expect_refused(settings({"--builtin", "sphere-plane", "--engine", "unity"}), 2,
                   "Unity URP: Gnomon does not know its settings for a spot light");
    expect_refused(settings({"--builtin", "yard"}), 2, "--engine is required");
    expect_refused(
        settings({"--builtin", "yard", "--engine", "three", "--set", "method.name=shadow_volumes"}),
        2, "it has no shadow map to translate");
    expect_refused(settings({"--builtin", "yard", "--engine", "three", "--set", "method.name=vsm"}),
                   2, "set it with --set method.name=depth");
}

} // namespace
} // namespace gnomon::testing
