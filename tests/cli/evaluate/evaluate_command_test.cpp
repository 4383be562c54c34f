#include "case_folder.hpp"
#include "lane.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using CaseJson = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

CaseJson evaluated(const CaseFolder& folder, const std::vector<std::string>& more = {})
{
    const Ending ending = folder.evaluate(with({"--json"}, more));
    EXPECT_EQ(ending.exit_code, 0) << ending.command << ending.err;
    return CaseJson::parse(ending.out, nullptr, false);
}

/// The scene, and settings that decide which lookups a case holds.
struct RoundTrip {
    std::string scene;
    std::vector<std::string> settings;
};

TEST(Evaluate, GivesTheCountsOfCompareForGlsOwnCase)
{
    // The usual lane lays the settings over fewer scenes.
    const std::vector<RoundTrip> few{
        {"sphere-cube", {"--set", "lookup.filter=hardware", "--set", "shadow_map.resolution=512"}},
        {"yard", {"--set", "bias.normal_texels=2", "--set", "shadow_map.resolution=256"}}, // pcf3
        {"wall",
         {"--set", "lookup.filter=linear", "--set", "bias.slope=1e-4", "--set",
          "shadow_map.reversed=true", "--set", "shadow_map.fit=camera"}},
        {"room",
         {"--set", "camera.eye=[0,2,6]", "--set", "camera.target=[0,0.5,0]", "--set",
          "camera.orthographic_height=4", "--set", "shadow_map.resolution=256"}},
    };
    const std::vector<RoundTrip> all{
        {"sphere-plane", {}},
        {"yard", {}}, // pcf3
        {"playground", {"--set", "bias.normal_texels=2"}},
        {"sphere-cube", {"--set", "lookup.filter=hardware"}},
        {"terrain", {"--set", "lookup.filter=linear", "--set", "bias.slope=1e-4"}},
        {"wall", {"--set", "shadow_map.reversed=true", "--set", "shadow_map.fit=camera"}},
        {"room",
         {"--set", "camera.eye=[0,2,6]", "--set", "camera.target=[0,0.5,0]", "--set",
          "camera.orthographic_height=4"}},
    };
    for (const RoundTrip& trip : tests::in_lane(few, all)) {
        const CaseFolder folder{trip.scene, trip.settings};
        const CaseJson own = CaseJson::parse(folder.compared.out);
        const CaseJson back = evaluated(folder);
        for (const char* const name : {"false_shadow", "false_lit", "error_rate", "mean_abs_error",
                                       "causes", "labels", "peter_panning_gap_m", "by_object"}) {
            EXPECT_EQ(own.at(name), back.at(name)) << folder.compared.command << "\n" << name;
        }
        // Hardware filtering has the driver's weights, but other biases are predicted with exact
        // ones: a few pixels differ.
        const bool has_formula = own.at("job").at("lookup.filter") != "hardware";
        EXPECT_TRUE(back.at("bias_curve").is_object()) << folder.compared.command;
        if (has_formula) {
            EXPECT_EQ(back.at("bias_curve"), own.at("bias_curve")) << folder.compared.command;
        }
        for (const char* const name :
             {"attached", "out_of_light", "indeterminate", "lit", "blocked"}) {
            EXPECT_EQ(own.at("pixels").at(name), back.at("pixels").at(name))
                << folder.compared.command << "\n"
                << name;
        }
        EXPECT_EQ(back.at("indeterminate_kinds").at("rounding"), 0) << folder.compared.command;
        EXPECT_TRUE(back.at("evaluate").at("cannot_know").empty()) << folder.compared.command;
    }
}

TEST(Evaluate, TakesReceiversBeyondTheFarPlane)
{
    const CaseFolder folder{"yard", {"--set", "shadow_map.far=30"}};
    const CaseJson own = CaseJson::parse(folder.compared.out);
    EXPECT_GT(own.at("causes").at("coverage"), 0);
    EXPECT_EQ(evaluated(folder).at("causes"), own.at("causes"));
}

TEST(Evaluate, SaysAtLevel0WhatItCannotKnow)
{
    CaseFolder folder{"sphere-plane"};
    folder.keep_level_0();
    folder.drop_table("camera");
    folder.write();
    const CaseJson json = evaluated(folder);
    EXPECT_EQ(json.at("evaluate").at("level"), 0);
    EXPECT_TRUE(json.at("pixels").at("attached").is_null());
    EXPECT_TRUE(json.at("causes").is_null());
    EXPECT_THAT(json.at("evaluate").at("cannot_know").dump(), HasSubstr("Ng or camera.eye"));
    EXPECT_THAT(folder.evaluate({"--verbose"}).out, HasSubstr("cannot know attached"));
    EXPECT_THAT(folder.evaluate().out, HasSubstr("\nunknown   Attached (the side that is seen"));
}

TEST(Evaluate, FindsTheBiasWhereOnlyTheDepthsAreKnown)
{
    CaseFolder folder{"yard", {"--set", "bias.constant=0.02", "--set", "lookup.filter=nearest"}};
    const CaseJson own = CaseJson::parse(folder.compared.out);
    folder.channels.erase("texel.X");
    folder.channels.erase("texel.Y");
    folder.write();
    const CaseJson json = evaluated(folder);
    EXPECT_GT(own.at("causes").at("bias"), 100);
    // Without texels self-shadowing cannot be seen, so a few more pixels are unexplained.
    EXPECT_GE(json.at("causes").at("bias"), own.at("causes").at("bias"));
    EXPECT_LE(json.at("causes").at("bias"), 1.05 * own.at("causes").at("bias").get<double>());
    EXPECT_EQ(json.at("labels").at("peter_panning"), json.at("causes").at("bias"));
    for (const char* cause : {"precision", "filter", "resolution", "coverage"}) {
        EXPECT_TRUE(json.at("causes").at(cause).is_null()) << cause;
    }
    for (const char* label : {"acne", "bleed", "leak", "edge", "overshadow"}) {
        EXPECT_TRUE(json.at("labels").at(label).is_null()) << label;
    }
}

/// Gnomon has no shadow map for its light, so none may be requested.
TEST(Evaluate, JudgesAPointLightInEveryFormat)
{
    CaseFolder folder{"sphere-plane"};
    folder.keep_level_0();
    folder.toml = R"(schema = 1
renderer = "By hand"
[mesh]
file = "mesh.glb"
[light]
type = "point"
position = [2.5, 4.8, 4.3]
)"; // of the scene's spot
    folder.write();
    const Ending table = folder.evaluate();
    EXPECT_EQ(table.exit_code, 0) << table.err;
    EXPECT_THAT(table.out, HasSubstr("point"));
    const CaseJson json = evaluated(folder);
    EXPECT_TRUE(json.at("frustum").is_null());
    EXPECT_GT(json.at("pixels").at("lit"), 1000);
    EXPECT_GT(json.at("pixels").at("blocked"), 100);
    const std::string picture = folder.at("point.png");
    EXPECT_EQ(folder.evaluate({"--picture", picture}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(picture));
    const std::string run = folder.at("run");
    expect_done(folder.evaluate({"--out", run}));
    EXPECT_EQ(gnomon({"report", run}).exit_code, 0);
}

TEST(Evaluate, LeavesARunForReportGateAndBaseline)
{
    CaseFolder folder{"sphere-plane"};
    const std::string run = folder.at("run");
    const std::string baseline = folder.at("baseline.json");
    expect_done(folder.evaluate({"--out", run}));
    EXPECT_EQ(gnomon({"baseline", "save", run, "--baseline", baseline}).exit_code, 0);
    EXPECT_EQ(gnomon({"gate", run, "--baseline", baseline}).exit_code, 0);
    EXPECT_EQ(gnomon({"report", run}).exit_code, 0);
    for (const char* const file : {"report.html", "summary.md"}) {
        const std::string text = text_of(std::filesystem::path{run} / file);
        EXPECT_THAT(text, HasSubstr("Shadow-map accuracy: sphere-plane")) << file;
        EXPECT_THAT(text, Not(HasSubstr("GL version"))) << file;
        EXPECT_THAT(text, Not(HasSubstr(", another renderer,"))) << file;
    }

    auto& mask = folder.channels["shadow.V"];
    for (int x = 110; x < 130; ++x) {
        mask(x, 120) = 1 - mask(x, 120); // the sunny ground before the sphere
    }
    folder.write();
    const std::string other = folder.at("other");
    expect_done(folder.evaluate({"--out", other}));
    EXPECT_EQ(gnomon({"gate", other, "--baseline", baseline}).exit_code, 1);

    folder.replace("renderer = \"", "renderer = \"Another ");
    folder.write();
    const std::string foreign = folder.at("foreign");
    expect_done(folder.evaluate({"--out", foreign}));
    EXPECT_EQ(gnomon({"gate", foreign, "--baseline", baseline}).exit_code, 3);
}

TEST(Evaluate, KeepsARunWithoutASettingForTheReport)
{
    CaseFolder folder{"sphere-plane"};
    folder.keep_level_0();
    for (const char* const table : {"camera", "shadow_map", "lookup", "bias", "objects"}) {
        folder.drop_table(table);
    }
    folder.write();
    const std::string run = folder.at("run");
    expect_done(folder.evaluate({"--out", run}));
    const Ending report = gnomon({"report", run});
    EXPECT_EQ(report.exit_code, 0);
    EXPECT_EQ(report.err.find("left out"), std::string::npos) << report.err;
    EXPECT_EQ(csv_rows(run + "/results.csv").at(0).at("shadow_map.resolution"), "");
}

TEST(Evaluate, TakesTheMeshIntoTheRenderersSpace)
{
    CaseFolder folder{"yard", {"--set", "light.direction=[-0.4,-1,-0.3]"}};
    const CaseJson own = CaseJson::parse(folder.compared.out);
    folder.keep_level_0();
    folder.move([](float&, float& y, float& z) {
        const float up = y;
        y = -z;
        z = up;
    });
    folder.drop_table("camera");
    folder.replace("direction = [-0.4, -1, -0.3]", "direction = [-0.4, 0.3, -1]");
    folder.toml += "\n[conventions]\nup = \"z\"\n";
    folder.write();
    const CaseJson json = evaluated(folder);
    // Level 0 scores pixels as blocked that level 1 calls attached.
    EXPECT_EQ(json.at("pixels").at("lit"), own.at("pixels").at("lit"));
    EXPECT_EQ(json.at("false_shadow"), own.at("false_shadow"));
}

/// Changes a case.toml, and expects a refusal with that text.
void expect_toml_refused(const std::string& from, const std::string& to, const std::string& text)
{
    static CaseFolder folder{"sphere-plane"};
    folder.restore();
    folder.replace(from, to);
    folder.write();
    expect_refused(folder.evaluate(), 2, text);
}

TEST(Evaluate, RefusesACaseTomlInOneLine)
{
    expect_toml_refused("schema = 1", "schema = 2", "schema = 2: must be");
    expect_toml_refused("schema = 1", "", "schema = 1 is missing");
    expect_toml_refused("renderer", "rendrer", "the nearest is renderer");
    expect_toml_refused("file = \"mesh.glb\"", "fiel = \"mesh.glb\"", "the nearest is mesh.file");
    expect_toml_refused("mesh.glb", "no.glb", "no.glb");
    expect_toml_refused("[objects]\n", "[objects]\n\"nothing\" = 77\n", "the nearest is");
    expect_toml_refused("no_cast = []", "no_cast = [\"nothing\"]",
                        "case.toml: mesh.no_cast = [\"nothing\"]: ");
    expect_toml_refused("schema = 1", "", "`gnomon capture-kit` writes a template");
    expect_toml_refused("[lookup]", "[lokup]", "the nearest is lookup");
    expect_toml_refused("[light]", "[conventions]\naxes = [\"x\", \"x\", \"y\"]\n[light]",
                        "conventions.axes");
    expect_toml_refused("[light]", "[scene]\nground = true\n[light]", "unknown");
}

TEST(Evaluate, NamesTheFileOfALightThatIsNone)
{
    CaseFolder folder{"sphere-plane"};
    folder.keep_level_0();
    folder.drop_table("light");
    folder.drop_table("shadow_map");
    folder.toml += "\n[light]\ntype = \"spot\"\nposition = [0, 1, 0]\ntarget = [0, 1, 0]\n";
    folder.write();
    expect_refused(folder.evaluate(), 2, "case.toml: light.position equals light.target");
}

TEST(Evaluate, RefusesAnImageInOneLine)
{
    CaseFolder whole{"sphere-plane"};
    const auto expect = [&](const std::function<void(CaseFolder&)>& change,
                            const std::string& text) {
        CaseFolder& folder = whole;
        folder.restore();
        change(folder);
        folder.write();
        expect_refused(folder.evaluate(), 2, text);
    };
    expect([](CaseFolder& folder) { folder.channels.erase("shadow.V"); }, "no channel shadow.V");
    expect([](CaseFolder& folder) { folder.channels.erase("P.Y"); }, "no channel P.Y");
    expect([](CaseFolder& folder) { folder.channels["shadow.V"](120, 100) = NAN; },
           "shadow.V is NaN at pixel (120, 100)");
    expect([](CaseFolder& folder) { folder.channels["shadow.V"](120, 100) = 3; },
           "channels.lit_above");
    expect([](CaseFolder& folder) { folder.channels["P.X"](120, 100) = INFINITY; },
           "P is not finite at pixel (120, 100)");
    expect([](CaseFolder& folder) { folder.channels["P.X"](120, 100) = 1e30F; }, "beyond 1e15");
    for (const float depth : {-0.5F, 1.5F}) {
        expect([&](CaseFolder& folder) { folder.channels["z.map"](120, 100) = depth; },
               fmt::format("z.map = {} at pixel (120, 100): a shadow map's depths", depth));
    }
    expect(
        [](CaseFolder& folder) {
            auto& depths = folder.channels["z.light"];
            depths = scene::Image<float>{depths.size(), 5.0F}; // in metres
        },
        "z.light = 5 at pixel (");
    for (const float number : {0.5F, -1.0F, NAN, 2e7F}) {
        expect([&](CaseFolder& folder) { folder.channels["id.geom"](120, 100) = number; },
               "at pixel (120, 100): an object's number is a whole number");
    }
    expect(
        [](CaseFolder& folder) {
            folder.channels.erase("id.geom");
            folder.replace("[objects]\n", "[objects]\n\"nothing\" = 77\n");
        },
        "the mesh has no such object");
    expect(
        [](CaseFolder& folder) {
            folder.channels["valid"] = scene::Image<float>{{240, 136}};
        },
        "no pixel can be judged");
}

/// Writes the file with some bytes of a header attribute's value replaced.
void overwrite_attribute(const std::filesystem::path& file, std::string_view name,
                         std::string_view type, const std::string& bytes)
{
    std::string whole = text_of(file);
    const std::string head = fmt::format("{}{}{}{}", name, '\0', type, '\0');
    whole.replace(whole.find(head) + head.size() + 4, bytes.size(), bytes);
    std::ofstream{file, std::ios::binary} << whole;
}

TEST(Evaluate, RefusesImagesThatAreEncodedOtherwise)
{
    const CaseFolder folder{"sphere-plane"};
    const auto file = folder.at("aov.exr");
    for (const auto& [code, name] : {std::pair{'\5', "pxr24"},
                                     {'\6', "b44"},
                                     {'\7', "b44a"},
                                     {'\10', "dwaa"},
                                     {'\11', "dwab"}}) {
        overwrite_attribute(file, "compression", "compression", std::string(1, code));
        expect_refused(folder.evaluate(), 2,
                       fmt::format("compressed with {}, which changes numbers", name));
    }
    folder.write();
    overwrite_attribute(file, "displayWindow", "box2i", std::string{"\1\0\0\0", 4});
    expect_refused(folder.evaluate(), 2, "the data window is not the display window");
}

TEST(Evaluate, RefusesToExportAnImageOfNothing)
{
    const TemporaryFolder folder;
    const std::string case_path = (folder.path() / "case").string();
    const Ending ending =
        gnomon({"compare", "--builtin", "sphere-plane", "--export-case", case_path, "--set",
                "camera.eye=[0,5,0]", "--set", "camera.target=[0,9,1]"});
    expect_refused(ending, 2, "no pixel of the image can be judged");
    EXPECT_FALSE(std::filesystem::exists(case_path));
}

TEST(Evaluate, RefusesDamagedImagesInOneLine)
{
    const CaseFolder folder{"sphere-plane"};
    const std::string whole = text_of(folder.at("aov.exr"));
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{3}, std::size_t{100}, whole.size() / 2, whole.size() - 9}) {
        std::ofstream{folder.at("aov.exr"), std::ios::binary} << whole.substr(0, length);
        expect_refused(folder.evaluate(), 2, "aov.exr");
    }
    // The data window's right edge, in an otherwise valid header: far too many pixels.
    std::string huge = whole;
    huge.replace(huge.find("box2i", huge.find("dataWindow")) + 6 + 4 + 8, 8,
                 std::string{"\xFF\xFF\x0F\x00\xFF\xFF\x0F\x00", 8});
    std::ofstream{folder.at("aov.exr"), std::ios::binary} << huge;
    expect_refused(folder.evaluate(), 2, "aov.exr");
}

} // namespace
} // namespace gnomon::testing
