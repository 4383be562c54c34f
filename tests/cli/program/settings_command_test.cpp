// `gnomon settings`: what to type in an engine.

#include "case_folder.hpp"
#include "child_process.hpp"
#include "run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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

TEST(SettingsCommand, TakesAnEnginesAliasInAnyCase)
{
    const std::vector<std::string> yard{"--builtin", "yard", "--engine"};
    EXPECT_EQ(settings_json(with(yard, {"URP"})).at(0).at("engine"), "unity");
    EXPECT_EQ(settings_json(with(yard, {"three.js"})).at(0).at("engine"), "three");
}

TEST(SettingsCommand, WritesTheLookupForAShaderLanguage)
{
    const Ending glsl = settings({"--builtin", "yard", "--engine", "GLSL", "--own", "--set",
                                  "bias.constant=0.125", "--set", "lookup.filter=nearest"});
    expect_done(glsl);
    EXPECT_THAT(glsl.out, AllOf(HasSubstr("GLSL, with the job's own bias:\n"),
                                HasSubstr("\n  uniform sampler2D shadow_map; // 1024 x 1024, "),
                                HasSubstr("\n  float visibility(vec3 position, vec3 N, vec3 L)\n"),
                                HasSubstr("\n      float bias = 0.125;\n"),
                                HasSubstr("Gnomon's own map with this bias "),
                                HasSubstr("Draw the map with the states of --engine gl, ")));
    expect_refused(settings({"--builtin", "lamp-room", "--engine", "hlsl"}), 2,
                   "does not write lookups in a cube");
}

TEST(SettingsCommand, PrintsTheStatesOfAGraphicsApi)
{
    const std::vector<std::string> job{"--builtin",
                                       "yard",
                                       "--own",
                                       "--set",
                                       "bias.polygon_offset_factor=2",
                                       "--set",
                                       "bias.polygon_offset_units=4",
                                       "--engine"};
    const auto lines = [&](const std::string& api) {
        const Json json = settings_json(with(job, {api}));
        EXPECT_EQ(json.at(0).at("engine"), api);
        EXPECT_TRUE(json.at(0).at("false_lit_rate").is_number());
        return json.at(0).at("lines").dump();
    };
    EXPECT_THAT(lines("gl"), HasSubstr("glPolygonOffset(2, 4);"));
    EXPECT_THAT(lines("direct3d"), HasSubstr("DepthBias = 4, SlopeScaledDepthBias = 2"));
    EXPECT_THAT(lines("vulkan"), HasSubstr("depthBiasConstantFactor = 4"));
}

TEST(SettingsCommand, PromisesNoErrorsWhereNoLineAppliesABias)
{
    const std::vector<std::string> job{"--builtin", "yard", "--set", "bias.adaptive_m=0.01"};
    for (const char* target : {"gl", "glsl"}) {
        const Json lights = settings_json(with(job, {"--engine", target}));
        EXPECT_EQ(lights.at(0).at("cannot"), Json{"bias.adaptive_m = 0.01"}) << target;
        EXPECT_TRUE(lights.at(0).at("false_lit_rate").is_null()) << target;
    }
}

/// The JSON of `settings` for a run, which has its own jobs.
Json run_settings(const std::string& run, const std::vector<std::string>& more = {})
{
    const Ending ending =
        gnomon(with({"settings", run, "--engine", "three", "--own", "--json"}, more));
    expect_done(ending);
    return Json::parse(ending.out);
}

TEST(SettingsCommand, TranslatesTheBestConfigurationOfARun)
{
    const TemporaryFolder folder;
    const std::string run = folder.path() / "run";
    swept({"sweep", "--builtin", "yard", "--set", "image.width=96", "--set", "image.height=54",
           "--axis", "shadow_map.resolution=[64,1024]", "--axis", "bias.constant=[0.0,0.005]",
           "--out", run});
    auto rows = csv_rows(run + "/results.csv");
    ASSERT_EQ(rows.size(), 4U);
    std::ranges::sort(rows, {}, [](const auto& row) { return std::stod(row.at("error_rate")); });
    const auto expect_row = [&](const Json& lights, const auto& row) {
        ASSERT_EQ(lights.size(), 1U);
        EXPECT_EQ(lights.at(0).at("configuration"), row.at("id"));
        EXPECT_EQ(value_of(lights, "light.shadow.mapSize"),
                  std::stoi(row.at("shadow_map.resolution")));
        EXPECT_NEAR(value_of(lights, "light.shadow.bias").template get<double>(),
                    -std::stod(row.at("bias.constant")), 1e-9); // rounded to float32 near 0.005
        // The same job gives the same errors, printed with 17 digits.
        EXPECT_DOUBLE_EQ(lights.at(0).at("false_lit_rate").template get<double>(),
                         std::stod(row.at("false_lit_rate")));
    };
    expect_row(run_settings(run), rows.front());
    expect_row(run_settings(run, {"--configuration", rows.back().at("id")}), rows.back());
}

TEST(SettingsCommand, TranslatesTheBestOfEachCaseOfARun)
{
    const TemporaryFolder folder;
    const std::string run = folder.path() / "run";
    swept(sweep(folder.write("job.toml", two_lights), run));
    const Json lights = run_settings(run);
    ASSERT_EQ(lights.size(), 2U);
    EXPECT_EQ(lights.at(0).at("case"), "spot");
    EXPECT_TRUE(lights.at(0).at("positional"));
    EXPECT_EQ(lights.at(1).at("case"), "sun");
    EXPECT_FALSE(lights.at(1).at("positional"));
}

TEST(SettingsCommand, TranslatesARunOfASceneFile)
{
    const TemporaryFolder folder;
    const std::string run = folder.path() / "run";
    folder.write("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto job = folder.write("job.toml", "scene.file = \"model.obj\"\nscene.ground = true\n"
                                              "image.width = 64\nimage.height = 36\n"
                                              "light.type = \"directional\"\n"
                                              "light.direction = [0.3, -1, 0.2]\n");
    EXPECT_EQ(gnomon({"compare", job, "--out", run}).exit_code, 0);
    EXPECT_EQ(run_settings(run).size(), 1U);
}

TEST(SettingsCommand, RefusesRunsWithoutAJobToTranslate)
{
    const TemporaryFolder folder;
    const std::string empty = folder.path();
    expect_refused(gnomon({"settings", empty, "--engine", "three"}), 2, "results.sqlite");
    const CaseFolder shown{"sphere-plane"};
    const std::string run = folder.path() / "run";
    EXPECT_EQ(gnomon({"evaluate", shown.path(), "--out", run}).exit_code, 0);
    expect_refused(gnomon({"settings", run, "--engine", "three"}), 2,
                   "drew these shadows, so Gnomon has no job to compare");
    const std::string own = folder.path() / "own";
    EXPECT_EQ(gnomon(small({"compare", "--builtin", "yard", "--out", own})).exit_code, 0);
    expect_refused(gnomon({"settings", own, "--engine", "three", "--configuration", "none"}), 2,
                   "it has no measured configuration none");
    expect_refused(settings({own, "--engine", "three"}), 2, "a run has its own jobs");
    expect_refused(settings({"--builtin", "yard", "--engine", "three", "--configuration", "none"}),
                   2, "--configuration needs the folder of a run");
}

TEST(SettingsCommand, RefusesUnknownEnginesAndOtherLights)
{
    expect_refused(settings({"--builtin", "yard", "--engine", "glls"}), 2,
                   "--engine glls: unknown engine; the nearest is glsl");
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
