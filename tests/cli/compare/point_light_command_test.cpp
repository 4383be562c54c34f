// Jobs with point lights: refused settings, and positions of the light.

#include "child_process.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using scene::test::QuadGltf;
using Json = nlohmann::json;
using Settings = std::vector<std::string>;

std::vector<std::string> with_settings(std::vector<std::string> arguments, const Settings& settings)
{
    for (const std::string& setting : settings) {
        arguments.insert(arguments.end(), {"--set", setting});
    }
    return arguments;
}

void expect_light_refused(const std::string& builtin, const Settings& settings,
                          const std::string& line)
{
    expect_refused(gnomon(with_settings({"compare", "--builtin", builtin}, settings)), 2,
                   "gnomon: " + line + "\n");
}

TEST(PointLightSettings, RefuseADirectionATargetAndACone)
{
    for (const auto& [setting, lights, first] :
         {std::tuple{"light.cone_deg=40", "spot", "spot"},
          {"light.direction=[0,-1,0]", "directional", "directional"},
          {"light.target=[0,0,0]", "directional or spot", "directional"}}) {
        const auto line = [&](const char* type) {
            return fmt::format("--set {}: is for a {} light, and this is a point light ({}); "
                               "remove it, or set light.type = \"{}\"",
                               setting, lights, type, first);
        };
        expect_light_refused("lamp-room", {setting},
                             line("built-in \"lamp-room\": light.type = \"point\""));
        expect_light_refused("yard", {"light.type=point", "light.position=[1,2,1]", setting},
                             line("--set light.type=point"));
    }
}

TEST(PointLightSettings, RefuseALightWithoutAPosition)
{
    expect_light_refused("wall", {"light.type=point"},
                         "--set light.type=point: a point light needs light.position");
}

TEST(PointLightSettings, RefuseAPositionThatIsNone)
{
    for (const char* const position :
         {"[nan,0,0]", "[0,inf,0]", "[0,0,1e16]", "[1,2]", "\"there\""}) {
        expect_light_refused("lamp-room", {fmt::format("light.position={}", position)},
                             fmt::format("--set light.position={}: must be three numbers "
                                         "[x, y, z] from -1e+15 to 1e+15",
                                         position));
    }
}

TEST(PointLightSettings, RefuseWhatSixMapsHaveNoUseFor)
{
    expect_light_refused("lamp-room", {"lookup.position=vertex"},
                         "--set lookup.position=vertex: with a point light it is \"pixel\", for "
                         "its six maps see all around; remove it");
    expect_light_refused("lamp-room", {"shadow_map.fit=camera"},
                         "--set shadow_map.fit=camera: with a point light it is \"scene\", for "
                         "its six maps see all around; remove it");
    // Not the advice to set fit = "fixed", which a point light cannot have either.
    for (const auto& [size, light] : {std::pair{"shadow_map.fov_deg=90", "spot"},
                                      {"shadow_map.half_extent=3", "directional"}}) {
        expect_light_refused(
            "lamp-room", {size},
            fmt::format("--set {0}: is for a {1} light, and this is a point light (built-in "
                        "\"lamp-room\": light.type = \"point\"); remove it, or set light.type = "
                        "\"{1}\"",
                        size, light));
    }
}

TEST(PointLightSettings, RefuseMethodsWhoseKernelsEndAtSeams)
{
    const std::string line = "method.name = \"vsm\": its kernels do not cross the seams of a cube, "
                             "so it does not support point lights; use \"depth\"";
    expect_light_refused("lamp-room", {"method.name=vsm"}, line);
    expect_light_refused("wall", {"light.type=point", "light.position=[0,5,0]", "method.name=vsm"},
                         line);
}

TEST(PointLightSettings, RefuseOtherLightsACube)
{
    const std::string line =
        "--set shadow_map.layout=cube: only a point light's maps are the faces of a cube; remove "
        "it, or set light.type = \"point\"";
    expect_light_refused("sphere-cube", {"shadow_map.layout=cube"}, line); // a spot
    expect_light_refused("wall", {"shadow_map.layout=cube"}, line);        // a directional light
    const TemporaryFolder folder;
    const auto model = folder.write("model.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
    expect_refused(gnomon(with_settings({"compare", model}, {"shadow_map.layout=cube"})), 2,
                   "gnomon: shadow_map.layout = \"cube\": the scene's light is a directional "
                   "light; remove the key, or give a light under [light]\n");
}

/// A glTF quad with a point light in front of it.
std::string lit_quad()
{
    QuadGltf gltf;
    gltf.more = R"("extensionsUsed":["KHR_lights_punctual"],)"
                R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},)";
    gltf.nodes = R"([{"mesh":0},{"name":"light","translation":[0.2,0.4,1],)"
                 R"("extensions":{"KHR_lights_punctual":{"light":0}}}])";
    gltf.roots = "[0,1]";
    return gltf.text();
}

/// A job does not write shadow_map.content if it is depth.
TEST(PointLightSweep, TellsConfigurationsApartByWhatTheirMapsStore)
{
    const TemporaryFolder folder;
    const auto run = folder.path() / "run";
    const Ending sweep = gnomon({"sweep", "--builtin", "lamp-room", "--out", run, "--quiet",
                                 "--set", "image.width=64", "--set", "image.height=36", "--axis",
                                 "shadow_map.content=depth,distance"});
    EXPECT_EQ(sweep.exit_code, 0) << sweep.err;
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("shadow_map.content"), "depth");
    EXPECT_EQ(rows[1].at("shadow_map.content"), "distance");
    const auto baseline = folder.path() / "baseline.json";
    EXPECT_EQ(gnomon({"baseline", "save", run, "--baseline", baseline}).exit_code, 0);
    EXPECT_EQ(gnomon({"gate", run, "--baseline", baseline}).exit_code, 0);
}

/// If a file's own light is not valid, only its rows fail, in any order of the files.
TEST(PointLightSweep, OfASceneFilesOwnLightFailsNoOtherRows)
{
    const TemporaryFolder folder;
    const auto model = folder.write("model.gltf", lit_quad());
    for (const auto& [axis, refused] :
         {std::pair{R"(lookup.position=["vertex","pixel"])", "vertex"},
          {R"(lookup.position=["pixel","vertex"])", "vertex"},
          {R"(method.name=["vsm","depth"])", "vsm"},
          {R"(method.name=["depth","vsm"])", "vsm"}}) {
        const std::string run = folder.path() / "run";
        std::filesystem::remove_all(run);
        const Ending swept =
            gnomon(small({"sweep", model, "--out", run, "--axis", axis, "--quiet"}));
        EXPECT_EQ(swept.exit_code, 5) << axis;
        std::ifstream csv{run + "/results.csv"};
        int done = 0;
        int failed = 0;
        for (std::string line; std::getline(csv, line);) {
            done += line.find(",done,") != std::string::npos ? 1 : 0;
            const bool has_failed = line.find(",failed,") != std::string::npos;
            failed += has_failed ? 1 : 0;
            EXPECT_TRUE(!has_failed || line.find(refused) != std::string::npos) << line;
        }
        EXPECT_EQ(done, 1) << axis;
        EXPECT_EQ(failed, 1) << axis;
    }
}

TEST(PointLightSettings, AreHeldToTheLightOfASceneFile)
{
    const TemporaryFolder folder;
    const auto model = folder.write("model.gltf", lit_quad());
    expect_done(gnomon(small({"compare", model})));
    expect_done(gnomon(with_settings(small({"compare", model}), {"shadow_map.layout=cube"})));
    for (const auto& [setting, message] : {
             std::pair{"shadow_map.layout=single", "shadow_map.layout = \"single\""},
             {"lookup.position=vertex", "whose six maps are looked up from pixels"},
             {"shadow_map.fit=camera", "shadow_map.fit = \"camera\""},
             {"shadow_map.fit=fixed", "whose six maps see all around"},
             {"shadow_map.roll_deg=10", "whose six maps look along the world's axes"},
             {"shadow_map.near=0", "in front of it, above 0"},
             {"bias.constant_m=0.1", "needs a directional light"},
             {"method.name=vsm", "its kernels do not cross the seams of a cube"},
         }) {
        expect_refused(gnomon(with_settings({"compare", model}, {setting})), 2, message);
    }
}

TEST(PointLightOptions, RefuseLightsTurnedAboutADirection)
{
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"compare", "--advise"}, {"tune"}}) {
        std::vector<std::string> arguments = command;
        arguments.insert(arguments.end(), {"--builtin", "lamp-room", "--lights", "2"});
        expect_refused(
            gnomon(small(arguments)), 2,
            "gnomon: other lights: the job's light is a point light, which has no direction "
            "to vary; request none\n");
    }
}

/// Compares a built-in scene under a point light, certifies its truth, and returns its pixels.
Json certified_pixels(const std::string& builtin, const std::string& position)
{
    const TemporaryFolder folder;
    const std::string aov = folder.path() / "a.exr";
    const Settings settings{"light.type=point", "light.position=" + position};
    const Ending compared = gnomon(
        with_settings(small({"compare", "--builtin", builtin, "--json", "--aov", aov}), settings));
    expect_done(compared);
    expect_done(gnomon(
        with_settings(small({"certify", aov, "--builtin", builtin, "--sample", "500"}), settings)));
    return compared.exit_code == 0 ? Json::parse(compared.out).at("pixels") : Json::object();
}

TEST(PointLight, AtTheEyeLightsAllThatIsSeen)
{
    const Json pixels = certified_pixels("lamp-room", "[-2.1,1.7,2.2]");
    EXPECT_EQ(pixels.at("lit").get<int>() + pixels.at("unmatched").get<int>(), pixels.at("total"));
}

TEST(PointLight, InAClosedMeshLightsNothingOutside)
{
    const Json pixels = certified_pixels("sphere-cube", "[0,0,0]"); // in the middle of the cube
    EXPECT_EQ(pixels.at("lit"), 0);
    EXPECT_GT(pixels.at("blocked"), 0); // the sphere
    EXPECT_GT(pixels.at("attached"), 0);
}

TEST(PointLight, OnAVertexLightsWhatThatDoesNotHide)
{
    // The light is at the sheet's upper corner, in its plane: the sheet is attached and casts no
    // shadow.
    const Json pixels = certified_pixels("wall", "[0,2,2]");
    EXPECT_GT(pixels.at("attached"), 0);
    EXPECT_GT(pixels.at("lit"), 0);
    EXPECT_EQ(pixels.at("blocked"), 0);
}

TEST(PointLight, InThePlaneOfTheGroundLeavesItAttached)
{
    const Json pixels = certified_pixels("fence", "[-9,0,1.5]");
    EXPECT_EQ(pixels.at("indeterminate"), 0);
    EXPECT_GT(pixels.at("attached"), pixels.at("lit"));
}

} // namespace
} // namespace gnomon::testing
