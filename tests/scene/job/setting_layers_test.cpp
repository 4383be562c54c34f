// Replacement and exclusion of settings: built-in defaults, file, case, overrides.

#include "job_fixture.hpp"

#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

namespace gnomon::scene::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// Defaults that these tests build on: `wall` has a directional light by its direction and a bias in
// metres, `sphere-plane` a spot and planes at 0.5 and 10, `yard` a directional light by position
// and target and a fixed fit.
const std::string wall_job = "scene.builtin = \"wall\"\n";
const std::string sphere_plane = "scene.builtin = \"sphere-plane\"\n";
const std::string yard = "scene.builtin = \"yard\"\n";
const std::string model = "scene.file = \"model.obj\"\n";

TEST(SettingLayers, BuiltInsDefaultsLieBeneathTheFilesKeys)
{
    const Job job = job_of(sphere_plane + "image.width = 99\n").job;
    EXPECT_EQ(job.image.width_px, 99);
    EXPECT_EQ(job.light->type, LightType::spot);
    EXPECT_EQ(job.shadow_map.resolution_texels, 512);
}

TEST(SettingLayers, OverridesLieAboveCasesAndCasesAboveTheFile)
{
    const std::string text = wall_job +
                             "image = {width = 10, height = 10}\nshadow_map.resolution = 10\n"
                             "[[case]]\nname = \"a\"\nimage.width = 20\nimage.height = 20\n";
    const Job job = job_of(text, {{"image.width", "30"}}, "a").job;
    EXPECT_EQ(job.image.width_px, 30);
    EXPECT_EQ(job.image.height_px, 20);
    EXPECT_EQ(job.shadow_map.resolution_texels, 10);
}

TEST(SettingLayers, BuiltInsParametersChangeItsDefaults)
{
    const Job job = job_of(sphere_plane + "[scene.sphere-plane]\nlight = \"orthographic\"\n").job;
    EXPECT_EQ(job.light->type, LightType::directional);
    EXPECT_EQ(std::get<std::string>(job.scene.parameters.at("light")), "orthographic");
}

TEST(SettingLayers, KeepEveryBuiltInsOwnJobAsItIs)
{
    for (const char* name : {"wall", "sphere-plane", "yard"}) {
        const auto keys = resolved_keys(builtin_job(name).job);
        std::string text;
        for (const auto& [key, value] : keys) {
            text += key + " = " + value + "\n";
        }
        EXPECT_EQ(resolved_keys(job_of(text).job), keys) << text;
    }
}

TEST(SettingLayers, PartialCameraTakesTheDefaultsForTheRest)
{
    const Job job = job_of(model + "camera.eye = [9, 9, 9]\n").job;
    ASSERT_TRUE(job.camera);
    EXPECT_EQ(job.camera->eye, Vec3d(9, 9, 9));
    EXPECT_EQ(job.camera->target, Vec3d(0, 0.5, 0));
    EXPECT_EQ(job.camera->vertical_fov_deg, 45);
}

TEST(SettingLayers, PartialCameraKeepsTheBuiltInsRest)
{
    const Job built_in = builtin_job("wall").job;
    const Job job = job_of(wall_job + "camera.eye = [9, 9, 9]\n").job;
    EXPECT_EQ(job.camera->eye, Vec3d(9, 9, 9));
    EXPECT_EQ(job.camera->target, built_in.camera->target);
}

TEST(SettingLayers, OrthographicHeightReplacesAPerspectiveAndBack)
{
    const Job job = job_of(wall_job + "camera.orthographic_height = 3\n").job;
    EXPECT_EQ(job.camera->projection, Projection::orthographic);
    EXPECT_EQ(job.camera->orthographic_height_m, 3);
    const Job back =
        job_of(wall_job + "camera.orthographic_height = 3\n", {{"camera.vertical_fov_deg", "30"}})
            .job;
    EXPECT_EQ(back.camera->projection, Projection::perspective);
    EXPECT_EQ(back.camera->vertical_fov_deg, 30);
}

TEST(SettingLayers, BiasInDepthUnitsReplacesABiasInMetresAndBack)
{
    const Job depth_units = job_of(wall_job + "bias.constant = 0.5\n").job;
    EXPECT_FALSE(depth_units.bias.constant_m);
    EXPECT_EQ(depth_units.bias.constant, 0.5);
    const Job metres = job_of(yard + "bias.constant_m = 0.5\n").job;
    EXPECT_EQ(metres.bias.constant_m, 0.5);
}

TEST(SettingLayers, DirectionalLightReplacesASpotsConeAndPointOfView)
{
    const Job job =
        job_of(sphere_plane + "[light]\ntype = \"directional\"\ndirection = [0, -1, 0]\n").job;
    EXPECT_EQ(job.light->type, LightType::directional);
    EXPECT_EQ(job.light->direction, Vec3d(0, -1, 0));
    EXPECT_FALSE(job.light->position);
    EXPECT_FALSE(job.light->target);
    EXPECT_FALSE(texts_by_key(job).contains("light.cone_deg"));
}

TEST(SettingLayers, DirectionalLightWithNoDirectionKeepsThePointOfViewOfASpot)
{
    const Job spot = builtin_job("sphere-plane").job;
    const Job job = job_of(sphere_plane + "light.type = \"directional\"\n").job;
    EXPECT_FALSE(job.light->direction);
    EXPECT_EQ(job.light->position, spot.light->position);
    EXPECT_EQ(job.light->target, spot.light->target);
}

TEST(SettingLayers, SpotReplacesADirectionAndAnExtent)
{
    const std::string light =
        "[light]\ntype = \"spot\"\nposition = [0, 9, 0]\ntarget = [0, 0, 0]\n";
    EXPECT_FALSE(job_of(wall_job + "bias.constant = 0\n" + light).job.light->direction);
    const Job job = job_of(yard + light).job;
    EXPECT_EQ(job.shadow_map.frustum.fit, Fit::fixed);
    EXPECT_FALSE(texts_by_key(job).contains("shadow_map.half_extent"));
}

TEST(SettingLayers, DirectionAloneOverASpotIsRefusedWithBothRemedies)
{
    EXPECT_EQ(refusal(sphere_plane + "light.direction = [0, -1, 0]\n"),
              "job.toml:2: light.direction = [0, -1, 0]: is for a directional light, and "
              "this is a spot light (built-in \"sphere-plane\": light.type = \"spot\"); remove it, "
              "or set light.type = \"directional\"");
}

TEST(SettingLayers, TargetReplacesADirectionFromBelow)
{
    const Job job = job_of(wall_job + "light.position = [1, 5, 0]\nlight.target = [0, 0, 0]\n").job;
    EXPECT_FALSE(job.light->direction);
    EXPECT_EQ(job.light->target, Vec3d(0, 0, 0));
    // Position alone places the directional light's camera.
    const Job moved = job_of(wall_job + "light.position = [1, 5, 0]\n").job;
    EXPECT_TRUE(moved.light->direction);
    EXPECT_EQ(moved.light->position, Vec3d(1, 5, 0));
}

TEST(SettingLayers, ADirectionalLightThatSaysNothingPointsTheDefaultWay)
{
    EXPECT_EQ(job_of(model + "light.type = \"directional\"\n").job.light->direction,
              Vec3d(-0.4, -1, -0.3));
}

TEST(SettingLayers, AnotherFitReplacesTheFixedExtent)
{
    const Job job = job_of(yard + "shadow_map.fit = \"scene\"\n").job;
    EXPECT_EQ(job.shadow_map.frustum.fit, Fit::scene);
    EXPECT_EQ(builtin_job("yard").job.shadow_map.frustum.fit, Fit::fixed);
}

TEST(SettingLayers, AnotherSceneLeavesTheParametersOfTheFormer)
{
    const std::string thick = wall_job + "scene.wall.thickness_m = 0.5\n";
    const auto thickness = [](const Job& job) {
        return std::get<double>(job.scene.parameters.at("thickness_m"));
    };
    EXPECT_EQ(thickness(job_of(thick).job), 0.5);
    EXPECT_EQ(thickness(job_of(thick, {{"scene.builtin", "wall"}}).job), 0.5);
    EXPECT_EQ(job_of(thick, {{"scene.builtin", "yard"}}).job.scene.builtin, "yard");
    const Job file = job_of(thick, {{"scene.file", "\"model.obj\""}}).job;
    EXPECT_EQ(file.scene.builtin, "");
    EXPECT_TRUE(file.scene.parameters.empty());
    EXPECT_FALSE(file.camera); // the wall's own camera went with it
}

TEST(SettingLayers, LastOverrideOfAKeyCounts)
{
    EXPECT_EQ(builtin_job("wall", {{"image.width", "1"}, {"image.width", "2"}}).job.image.width_px,
              2);
}

TEST(SettingLayers, RefuseTwoKeysThatExcludeEachOther)
{
    EXPECT_EQ(refusal(wall_job + model), "job.toml:2: scene.file = \"model.obj\": scene.builtin "
                                         "and this key are mutually exclusive (job.toml:1: "
                                         "scene.builtin = \"wall\"); keep one of the two");
    EXPECT_THAT(refusal(wall_job + "[camera]\nvertical_fov_deg = 40\northographic_height = 4\n"),
                StartsWith("job.toml:4: camera.orthographic_height = 4: camera.vertical_fov_deg "
                           "and this key are mutually exclusive"));
    EXPECT_THAT(refusal(wall_job + "bias = {constant = 0, constant_m = 1}\n"),
                HasSubstr("bias.constant and this key are mutually exclusive"));
    EXPECT_THAT(refusal(wall_job + "light.position = [0, 1, 0]\nlight.target = [0, 0, 0]\n"
                                   "light.direction = [0, -1, 0]\n"),
                StartsWith("job.toml:3: light.target = [0, 0, 0]: light.direction and this key are "
                           "mutually exclusive"));
}

TEST(SettingLayers, RefuseKeysOfTheOtherLight)
{
    EXPECT_THAT(
        refusal(wall_job + "light.cone_deg = 30\n"),
        HasSubstr("light.cone_deg = 30: is for a spot light, and this is a directional light "
                  "(built-in \"wall\": light.type = \"directional\"); remove it, or set "
                  "light.type = \"spot\""));
    EXPECT_THAT(refusal(model + "light.type = \"spot\"\nlight.position = [0, 1, 0]\n"),
                HasSubstr("a spot light needs light.target"));
    EXPECT_THAT(refusal(model + "light.target = [0, 0, 0]\n"), HasSubstr("needs light.position"));
    EXPECT_THAT(refusal(sphere_plane + "bias.constant_m = 0.1\n"),
                HasSubstr("a spot light's depth is not linear in metres; use bias.constant"));
    EXPECT_THAT(refusal(model + "light.type = \"point\"\n"),
                HasSubstr("a point light needs light.position"));
}

const std::string lamp = "scene.builtin = \"lamp-room\"\n";

TEST(SettingLayers, RefuseWhatAPointLightDoesNotHave)
{
    const auto refused = [](const std::string& keys) { return refusal(lamp + keys); };
    const std::string point = "light.type = \"point\"\nlight.position = [0, 1, 0]\n";
    EXPECT_THAT(refusal(model + point + "light.cone_deg = 30\n"),
                HasSubstr("light.cone_deg = 30: is for a spot light, and this is a point light "
                          "(job.toml:2: light.type = \"point\"); remove it"));
    EXPECT_THAT(refusal(model + point + "light.target = [0, 0, 0]\n"),
                HasSubstr("is for a directional or spot light, and this is a point light"));
    EXPECT_THAT(refused("shadow_map.layout = \"single\"\n"),
                HasSubstr("a point light's maps are the faces of a cube; remove it, or set "
                          "light.type = \"spot\""));
    EXPECT_THAT(refused("shadow_map.fit = \"camera\"\n"),
                HasSubstr("with a point light it is \"scene\""));
    EXPECT_THAT(refused("shadow_map.fov_deg = 90\n"),
                HasSubstr("is for a spot light, and this is a point light"));
    EXPECT_THAT(refused("lookup.position = \"vertex\"\n"),
                HasSubstr("with a point light it is \"pixel\""));
    EXPECT_THAT(refused("shadow_map.roll_deg = 10\n"),
                HasSubstr("a point light's maps look along the world's axes"));
    EXPECT_THAT(refused("shadow_map.near = 0\n"), HasSubstr("must be above 0 for a point light"));
    EXPECT_THAT(refused("bias.constant_m = 0.1\n"),
                HasSubstr("a point light's depth is not linear in metres"));
    EXPECT_THAT(refusal(sphere_plane + "shadow_map.layout = \"cube\"\n"),
                HasSubstr("only a point light's maps are the faces of a cube; remove it, or set "
                          "light.type = \"point\""));
    EXPECT_THAT(refusal(sphere_plane + "shadow_map.layout = \"cubes\"\n"),
                HasSubstr("the nearest is \"cube\""));
}

TEST(SettingLayers, RefuseDistancesWhereThereAreNone)
{
    const std::string distances = "shadow_map.content = \"distance\"\n";
    EXPECT_THAT(refusal(wall_job + distances), HasSubstr("a directional light is nowhere"));
    EXPECT_THAT(refusal(lamp + distances + "shadow_map.reversed = true\n"),
                HasSubstr("is for depth, not for distances"));
    EXPECT_THAT(refusal(lamp + distances + "lookup.filter = \"linear\"\n"),
                HasSubstr("a mean of distances"));
}

TEST(SettingLayers, RefuseFiltersThatAFormatIsNotMadeFor)
{
    const auto refused = [](const std::string& format, const std::string& filter) {
        return refusal(fmt::format("{}shadow_map.depth_format = \"{}\"\nlookup.filter = \"{}\"\n",
                                   lamp, format, filter));
    };
    for (const char* colour : {"r32f", "r16f", "rgba8"}) {
        EXPECT_THAT(refused(colour, "hardware"), HasSubstr("GL compares only depth formats"));
    }
    EXPECT_THAT(refused("rgba8", "linear"), HasSubstr("a mean of packed bytes"));
    for (const auto& [format, filter] :
         {std::pair{"r32f", "linear"}, {"r16f", "linear"}, {"rgba8", "pcf3"}, {"u8", "hardware"}}) {
        const Job job =
            job_of(lamp, {{"shadow_map.depth_format", format}, {"lookup.filter", filter}}).job;
        EXPECT_EQ(depth_format_name(job.shadow_map.depth_format), format);
    }
}

TEST(SettingLayers, LetAnotherKindOfLightReplaceWhatBelongedToTheOneBelow)
{
    const auto with = [](const std::string& text, const std::vector<Override>& overrides) {
        return job_of(text, overrides).job;
    };
    const Job point = with(wall_job + "shadow_map.fit = \"camera\"\nlookup.position = \"vertex\"\n",
                           {{"light.type", "point"}, {"light.position", "[0, 3, 1]"}});
    EXPECT_EQ(map_layout(point), MapLayout::cube);
    EXPECT_EQ(lookup_position(point), LookupPosition::pixel);
    EXPECT_EQ(point.shadow_map.frustum.fit, Fit::scene);
    const Job spot = with(lamp, {{"light.type", "spot"}, {"light.target", "[0, 0, 0]"}});
    EXPECT_EQ(map_layout(spot), MapLayout::single);
    EXPECT_EQ(lookup_position(spot), LookupPosition::vertex);
}

TEST(SettingLayers, RefuseAnExtentThatTheFitDoesNotUse)
{
    EXPECT_THAT(refusal(wall_job + "shadow_map.half_extent = 3\n"),
                HasSubstr("only for shadow_map.fit = \"fixed\""));
    const std::string fixed = "shadow_map.fit = \"fixed\"\n";
    EXPECT_THAT(refusal(wall_job + fixed + "shadow_map.fov_deg = 30\n"),
                HasSubstr("remove it, or use shadow_map.half_extent"));
    EXPECT_THAT(refusal(sphere_plane + fixed + "shadow_map.half_extent = 3\n"),
                HasSubstr("remove it, or use shadow_map.fov_deg"));
}

TEST(SettingLayers, RefuseNearThatIsNotBeforeFar)
{
    EXPECT_EQ(refusal(wall_job + "[shadow_map]\nnear = 5\nfar = 5\n"),
              "job.toml:3: shadow_map.near = 5: must be less than shadow_map.far (job.toml:4: "
              "shadow_map.far = 5)");
    EXPECT_THAT(refusal(sphere_plane + "shadow_map.near = 11\n"), // over the built-in's far
                HasSubstr("shadow_map.near = 11: must be less than shadow_map.far (built-in "));
    EXPECT_THAT(refusal(sphere_plane + "shadow_map.near = 0\n"),
                HasSubstr("shadow_map.near = 0: must be above 0 for a spot"));
    EXPECT_THAT(refusal(sphere_plane + "shadow_map.near = \"auto\"\nshadow_map.far = -1\n"),
                HasSubstr("shadow_map.far = -1: must be above 0 for a spot"));
    EXPECT_EQ(job_of(wall_job + "shadow_map.near = -5\nshadow_map.far = 0\n")
                  .job.shadow_map.frustum.near_m,
              -5);
}

TEST(SettingLayers, RefuseImagesThatAreTooLargeAltogether)
{
    EXPECT_EQ(job_of(wall_job + "image = {width = 16384, height = 8192}\n").job.image.height_px,
              8192);
    EXPECT_THAT(refusal(wall_job + "image = {width = 16384, height = 8193}\n"),
                HasSubstr("is 134234112 pixels; must be at most 134217728"));
    EXPECT_THAT(refusal(wall_job + "image = {width = 20000, height = 20000}\n"),
                HasSubstr("image.width = 20000: must be an integer from 1 to 16384"));
}

TEST(SettingLayers, RefuseParametersOfASceneThatIsNotShown)
{
    EXPECT_EQ(refusal(yard + "scene.wall.thickness_m = 1\n"),
              "job.toml:2: scene.wall.thickness_m = 1: the parameter of a scene that this job does "
              "not show; remove it, or set scene.builtin = \"wall\"");
    EXPECT_THAT(refusal(model + "scene.wall.thickness_m = 1\n"), HasSubstr("does not show"));
}

TEST(SettingLayers, RefuseAJobWithoutAScene)
{
    EXPECT_EQ(refusal("image.width = 3\n"), "job.toml: no scene: set scene.builtin (`gnomon "
                                            "scenes` lists them) or scene.file");
    EXPECT_THAT(refusal(""), StartsWith("job.toml: no scene"));
}

} // namespace
} // namespace gnomon::scene::test
