// `gnomon presets`, and --preset of the commands that take a job.

#include "child_process.hpp"
#include "run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using PresetsJson = nlohmann::json;

PresetsJson presets_from(std::vector<std::string> arguments)
{
    arguments.emplace_back("--json");
    const Ending ending = gnomon(arguments);
    expect_done(ending);
    return PresetsJson::parse(ending.out);
}

/// On `yard`, whose map is 40 m wide and whose range is 99.99 m.
const PresetsJson& presets_on_yard()
{
    static const PresetsJson json =
        presets_from({"presets", "--compare", "--builtin", "yard", "--set", "image.width=96",
                      "--set", "image.height=54"});
    return json;
}

std::set<std::string> names_in(const PresetsJson& array)
{
    std::set<std::string> names;
    for (const PresetsJson& preset : array) {
        names.insert(preset.at("name").get<std::string>());
    }
    return names;
}

/// Each preset once: compared, or left out with a reason.
void expect_all_of(const PresetsJson& comparison)
{
    std::set<std::string> names = names_in(comparison.at("presets"));
    for (const std::string& name : names_in(comparison.at("skipped"))) {
        EXPECT_TRUE(names.insert(name).second) << name;
    }
    EXPECT_EQ(names, names_in(presets_from({"presets"})));
}

const PresetsJson& preset_of(const PresetsJson& comparison, const std::string& name)
{
    const PresetsJson& all = comparison.at("presets");
    const auto found = std::find_if(all.begin(), all.end(), [&](const PresetsJson& preset) {
        return preset.at("name") == name;
    });
    EXPECT_NE(found, all.end()) << name;
    return *found;
}

TEST(PresetsCommand, ListsEachWithItsSourceAndWhatItCannotExpress)
{
    const Ending ending = gnomon({"presets"});
    expect_done(ending);
    EXPECT_THAT(ending.out, AllOf(HasSubstr("lesson-webgl: a depth texture of 512²"),
                                  HasSubstr("LightManager.h at fc9e5e2"), HasSubstr("  cannot  "),
                                  HasSubstr("glPolygonOffset(0.5, 0.5)")));
}

TEST(PresetsCommand, ListsThemAsJson)
{
    const PresetsJson all = presets_from({"presets"});
    EXPECT_EQ(all.size(), 20U);
    for (const PresetsJson& preset : all) {
        EXPECT_FALSE(preset.at("sentence").get<std::string>().empty());
        EXPECT_FALSE(preset.at("cannot").empty());
        EXPECT_EQ(preset.at("kind") == "lesson", !preset.at("own_scene").empty());
    }
    EXPECT_EQ(all[1].at("keys").at("bias.constant"), 0.1);
}

TEST(PresetsCommand, ComparesThoseOfADirectionalLight)
{
    const PresetsJson json = presets_from({"presets", "--compare", "--builtin", "wall", "--set",
                                           "image.width=96", "--set", "image.height=54"});
    EXPECT_EQ(json.at("light"), "directional");
    expect_all_of(json);
    EXPECT_EQ(json.at("presets").size(), 18U);
    for (const PresetsJson& preset : json.at("presets")) {
        EXPECT_EQ(preset.at("mismatch"), 0) << preset.at("name");
        EXPECT_EQ(preset.at("lit"), json.at("job").at("lit")) << preset.at("name");
        EXPECT_EQ(preset.at("blocked"), json.at("job").at("blocked")) << preset.at("name");
    }
}

TEST(PresetsCommand, ComparesThoseOfASpot)
{
    const PresetsJson json = presets_from({"presets", "--compare", "--builtin", "sphere-plane",
                                           "--set", "image.width=96", "--set", "image.height=54"});
    EXPECT_EQ(json.at("light"), "spot");
    expect_all_of(json);
    EXPECT_EQ(json.at("presets").size(), 7U);
    // Without a bias half of the lit pixels are shadowed if all faces cast, and almost none if only
    // back faces do.
    EXPECT_GT(preset_of(json, "lesson-webgl").at("false_shadow_rate"), 0.4);
    EXPECT_LT(preset_of(json, "three").at("false_shadow_rate"), 0.05);
}

TEST(PresetsCommand, SaysTheSameOfABiasInEveryUnit)
{
    const PresetsJson& json = presets_on_yard();
    const PresetsJson& filament = preset_of(json, "filament").at("bias");
    // The range of the scene's own planes is 99.99 m, and its map 40 m wide.
    // float32 rounds the bias once.
    EXPECT_NEAR(filament.at("constant_m").get<double>(), 0.001, 0.001 * 0x1p-23);
    EXPECT_NEAR(filament.at("constant").get<double>(), 0.001 / 99.99, 1e-5 * 0x1p-23);
    EXPECT_DOUBLE_EQ(filament.at("texel_m").get<double>(), 40.0 / 1024);
    EXPECT_NEAR(filament.at("constant_texels").get<double>(), 0.001 * 1024 / 40, 1e-8);
    EXPECT_NEAR(filament.at("constant_r").get<double>(), 0.001 / 99.99 * 0xFFFFFF, 1e-3);
    EXPECT_DOUBLE_EQ(filament.at("normal_offset_m").get<double>(), 40.0 / 1024);
}

TEST(PresetsCommand, SaysInEveryUnitWhatFurtherBiasesAre)
{
    const PresetsJson& json = presets_on_yard();
    const PresetsJson& unity = preset_of(json, "unity").at("further_bias");
    EXPECT_EQ(unity.at("keys"), PresetsJson({{"bias.constant_texels", 1.0}}));
    // A texel of 40 m / 2048, over a range of 99.99 m, whose steps are 1 / 65535.
    EXPECT_DOUBLE_EQ(unity.at("constant_texels").get<double>(), 1);
    EXPECT_NEAR(unity.at("constant_m").get<double>(), 40.0 / 2048, 1e-12);
    EXPECT_NEAR(unity.at("constant").get<double>(), 40.0 / 2048 / 99.99, 1e-12);
    EXPECT_NEAR(unity.at("constant_r").get<double>(), 40.0 / 2048 / 99.99 * 0xFFFF, 1e-8);
    EXPECT_EQ(unity.at("slope_m"), 0);
    const PresetsJson& filament = preset_of(json, "filament").at("further_bias");
    EXPECT_EQ(filament.at("keys"), PresetsJson({{"bias.polygon_offset_factor", 2.0},
                                                {"bias.polygon_offset_units", 0.5}}));
    // A unit is the driver's: one or two steps. It was measured to 2^-9 of itself.
    EXPECT_GE(filament.at("constant_r").get<double>(), 0.5 * (1 - 0x1p-8));
    EXPECT_LE(filament.at("constant_r").get<double>(), 1 + 0x1p-8);
    EXPECT_DOUBLE_EQ(filament.at("slope_m").get<double>(), 2 * 40.0 / 1024);
    const PresetsJson& mjp = preset_of(json, "mjp-shadows").at("further_bias");
    EXPECT_EQ(mjp.at("keys"), PresetsJson({{"bias.receiver_plane", "derivatives"},
                                           {"bias.receiver_plane_clamp", 0.01}}));
    EXPECT_EQ(mjp.at("constant"), 0);
    EXPECT_TRUE(preset_of(json, "three").at("further_bias").is_null());
    EXPECT_TRUE(json.at("job").at("further_bias").is_null());
}

TEST(PresetsCommand, PutsPresetsInPlaceOfTheJobsOwnSettings)
{
    const TemporaryFolder folder;
    const auto job = folder.write("job.toml", "scene.builtin = \"wall\"\nimage.width = 96\n"
                                              "image.height = 54\nlookup.filter = \"pcf9\"\n");
    const PresetsJson json = presets_from({"presets", "--compare", job});
    EXPECT_EQ(json.at("job").at("map").at("filter"), "pcf9");
    EXPECT_EQ(preset_of(json, "babylon").at("map").at("filter"), "nearest");
}

TEST(PresetsCommand, PrintsTheComparisonAsATable)
{
    const Ending ending = gnomon({"presets", "--compare", "--builtin", "wall", "--set",
                                  "image.width=96", "--set", "image.height=54"});
    expect_done(ending);
    EXPECT_THAT(ending.out,
                AllOf(HasSubstr("wall, directional light"), HasSubstr("polygon_offset_factor 2"),
                      HasSubstr("4 of 2048x2048 d32f"), HasSubstr("false shadow"),
                      HasSubstr("left out: playcanvas: not for a directional light")));
}

TEST(PresetsCommand, LeavesOutThoseThatASettingExcludes)
{
    const PresetsJson json = presets_from({"presets", "--compare", "--builtin", "sphere-plane",
                                           "--set", "lookup.filter=linear", "--set",
                                           "image.width=96", "--set", "image.height=54"});
    const PresetsJson& skipped = json.at("skipped");
    EXPECT_TRUE(std::any_of(skipped.begin(), skipped.end(), [](const PresetsJson& one) {
        return one.at("name") == "lesson-webgl-rgba8" &&
               one.at("why").get<std::string>().find("mean of packed bytes") != std::string::npos;
    }));
}

TEST(PresetsCommand, RefusesToCompareWithoutAMap)
{
    expect_refused(gnomon({"presets", "--compare", "--builtin", "wall", "--set",
                           "method.name=shadow_volumes"}),
                   2, "has no shadow map for presets to change");
}

TEST(PresetsCommand, RefusesAJobWithoutCompareAndSeveralLights)
{
    expect_refused(gnomon({"presets", "--builtin", "wall"}), 2, "a job needs --compare");
    expect_refused(gnomon({"presets", "--compare"}), 2, "no job");
    const TemporaryFolder folder;
    const auto job = folder.write(
        "job.toml", "scene.builtin = \"wall\"\n[[lights]]\nname = \"a\"\ndirection = [0, -1, 0.1]\n"
                    "[[lights]]\nname = \"b\"\ndirection = [0, -1, 0.2]\n");
    expect_refused(gnomon({"presets", "--compare", job}), 2, "choose one with --light, a or b");
}

TEST(PresetOption, RunsALessonWithItsOwnScene)
{
    const PresetsJson json = presets_from(small({"compare", "--preset", "lesson-webgl"}));
    EXPECT_EQ(json.at("scene").at("name"), "sphere-plane");
    EXPECT_EQ(json.at("job").at("shadow_map.resolution"), 512);
}

TEST(PresetOption, IsUnderstoodByEveryCommandThatTakesAJob)
{
    const TemporaryFolder folder;
    const std::string run = (folder.path() / "run").string();
    const std::string aov = (folder.path() / "aov.exr").string();
    expect_done(gnomon(small({"compare", "--preset", "lesson-lecture", "--aov", aov})));
    expect_done(gnomon(small({"certify", aov, "--preset", "lesson-lecture", "--sample", "20"})));
    expect_done(gnomon(
        {"sweep", "--preset", "lesson-lecture", "--axis", "bias.constant=0,0.1", "--dry-run"}));
    expect_done(gnomon(small({"sweep", "--builtin", "sphere-cube", "--preset", "lesson-lecture",
                              "--axis", "bias.constant=0,0.1", "--out", run, "--quiet"})));
    EXPECT_THAT(text_of(folder.path() / "run" / "results.csv"), HasSubstr("sphere-cube"));
    const Ending tuned = gnomon(small({"tune", "--preset", "lesson-game", "--quiet"}));
    EXPECT_TRUE(tuned.exit_code == 0 || tuned.exit_code == 1) << tuned.err;
}

TEST(PresetOption, GivesWhatItsKeysGive)
{
    const PresetsJson preset =
        presets_from(small({"compare", "--builtin", "sphere-plane", "--preset", "lesson-lecture"}));
    const PresetsJson keys =
        presets_from(small({"compare", "--builtin", "sphere-plane", "--set",
                            "shadow_map.resolution=1024", "--set", "bias.constant=0.1"}));
    for (const char* const member : {"job", "false_shadow", "false_lit", "exact_inputs"}) {
        EXPECT_EQ(preset.at(member), keys.at(member)) << member;
    }
}

TEST(PresetOption, IsRefusedInOneLine)
{
    expect_refused(gnomon({"compare", "--preset", "lesson-web"}), 2, "the nearest is lesson-webgl");
    expect_refused(gnomon({"compare", "--preset", "godot"}), 2, "it has no scene of its own");
    expect_refused(gnomon({"compare", "--builtin", "sphere-plane", "--preset", "godot"}), 2,
                   "it supports a directional light");
    expect_refused(gnomon({"compare", "--preset", "lesson-webgl", "--case", "a"}), 2,
                   "a preset has no cases");
}

} // namespace
} // namespace gnomon::testing
