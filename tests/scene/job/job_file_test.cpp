// Job files as a whole: reading, cases, overrides, messages, the template.

#include "job_fixture.hpp"

#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/load/load_scene.hpp"

namespace gnomon::scene::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string wall_scene = "[scene]\nbuiltin = \"wall\"\n";

TEST(JobFile, OfASceneFileAloneIsAJobOfDefaults)
{
    const JobFile read = read_job("models/chair.GLB");
    EXPECT_EQ(read.job.scene.file, "models/chair.GLB");
    EXPECT_FALSE(read.job.camera);
    EXPECT_FALSE(read.job.light);
    Job defaults;
    defaults.scene.file = "models/chair.GLB";
    EXPECT_EQ(resolved_keys(read.job), resolved_keys(defaults));
    EXPECT_TRUE(read.cases.empty());
}

TEST(JobFile, TakesOverridesOverASceneFile)
{
    const JobFile read = read_job("a.ply", {{"scene.ground", "true"}, {"lookup.filter", "pcf5"}});
    EXPECT_TRUE(read.job.scene.ground);
    EXPECT_EQ(read.job.lookup.filter, Filter::pcf5);
}

TEST(JobFile, SceneFilesAreRelativeToIt)
{
    EXPECT_EQ(job_of("scene.file = \"sub/a.obj\"\n").job.scene.file, job_folder() / "sub/a.obj");
    EXPECT_EQ(job_of("scene.file = \"/sub/a.obj\"\n").job.scene.file, "/sub/a.obj");
}

TEST(JobFile, ReadsEveryKindOfTableAlike)
{
    const auto expected =
        resolved_keys(job_of(wall_scene + "[bias]\nconstant = 0.5\nslope = 0.25\n").job);
    for (const std::string text : {
             "scene.builtin = \"wall\"\nbias.constant = 0.5\nbias.slope = 0.25\n",
             "scene = {builtin = \"wall\"}\nbias = {constant = 0.5, slope = 0.25}\n",
             "\"scene.builtin\" = \"wall\"\n\"bias.constant\" = 0.5\nbias.slope = 0.25\n",
         }) {
        EXPECT_EQ(resolved_keys(job_of(text).job), expected) << text;
    }
}

TEST(JobFile, ReadsTheExample)
{
    const std::filesystem::path path = std::filesystem::path{GNOMON_ROOT "/examples"} / "job.toml";
    const JobFile read = read_job(path);
    EXPECT_EQ(read.job.scene.builtin, "wall");
    EXPECT_EQ(read.job.image.width_px, 640);
    EXPECT_EQ(read.job.lookup.filter, Filter::pcf3);
    EXPECT_EQ(read.job.bias.constant_m, 0.004);
    ASSERT_EQ(read.sweep.axes.size(), 2U);
    EXPECT_EQ(read.sweep.axes[0].values.size(), 31U);
    ASSERT_EQ(read.cases.size(), 2U);
    EXPECT_EQ(read_job(path, {}, "noon").job.light->direction, Vec3d(0, -1, 0.1));
    const Job positional = read_job(path, {}, "spot").job;
    EXPECT_EQ(positional.light->type, LightType::spot);
    EXPECT_FALSE(positional.bias.constant_m);
}

TEST(JobFile, NamesTheNearestOfAnUnknownKeyWithItsLine)
{
    EXPECT_EQ(refusal(wall_scene + "[shadow_map]\nresolutoin = 3\n"),
              "job.toml:4: unknown key \"shadow_map.resolutoin\"; the nearest is "
              "shadow_map.resolution");
    EXPECT_EQ(refusal(wall_scene + "[shadowmap]\nresolution = 3\n"),
              "job.toml:3: unknown table \"shadowmap\"; the nearest is shadow_map");
    EXPECT_EQ(refusal(wall_scene + "[swep]\n"),
              "job.toml:3: unknown table \"swep\"; the nearest is sweep");
    EXPECT_EQ(refusal("resolution = 3\n"),
              "job.toml:1: unknown key \"resolution\"; the nearest is shadow_map.resolution");
    EXPECT_EQ(refusal(wall_scene + "[scene.wall]\nthickness = 3\n"),
              "job.toml:4: unknown key \"scene.wall.thickness\"; the nearest is "
              "scene.wall.thickness_m");
    // In the wrong table:
    EXPECT_EQ(refusal(wall_scene + "lookup.filter = \"pcf3\"\n"),
              "job.toml:3: unknown table \"scene.lookup\"; the nearest is lookup");
    EXPECT_EQ(refusal(wall_scene + "resolution = 3\n"),
              "job.toml:3: unknown key \"scene.resolution\"; the nearest is "
              "shadow_map.resolution");
    EXPECT_EQ(refusal("bias = 3\n"), "job.toml:1: bias = 3: must be a table, [bias]");
    EXPECT_EQ(refusal("[[bias]]\nslope = 1\n"),
              "job.toml:1: bias = [{…}]: must be a table, [bias]");
}

TEST(JobFile, NamesFileLineKeyValueAndRangeOfABadValue)
{
    EXPECT_EQ(refusal(wall_scene + "\n[shadow_map]\nresolution = -1\n"),
              "job.toml:5: shadow_map.resolution = -1: must be an integer from 1 to 16384");
    EXPECT_EQ(refusal("lookup.filter = \"pfc3\"\n"),
              "job.toml:1: lookup.filter = \"pfc3\": must be one of nearest, linear, hardware, "
              "pcf3, pcf5, pcf7, pcf9, bilinear3, bilinear5, bilinear7; the nearest is \"pcf3\"");
}

TEST(JobFile, RefusesAKeyGivenTwice)
{
    EXPECT_EQ(refusal("\"bias.slope\" = 0\nbias.slope = 1\n"),
              "job.toml:2: bias.slope = 1: the key is given twice; keep one");
    EXPECT_THAT(refusal("[bias]\nslope = 0\nslope = 1\n"), StartsWith("job.toml:3:"));
}

TEST(JobFile, NamesLineAndColumnWhereItIsNotToml)
{
    EXPECT_THAT(refusal(wall_scene + "[bias]\nslope = = 1\n"),
                StartsWith("job.toml:4:9: not TOML: "));
    EXPECT_THAT(refusal("[scene\n"), StartsWith("job.toml:1:"));
}

TEST(JobFile, RefusesPathsThatAreNoJob)
{
    const auto path = [](const std::string& name) { return job_folder() / name; };
    EXPECT_THAT(error_of([&] { return read_job(path("absent.toml")); }),
                HasSubstr("absent.toml: cannot be opened: No such file or directory"));
    EXPECT_THAT(error_of([&] { return read_job(job_folder()); }), HasSubstr("is a folder"));
    EXPECT_THAT(error_of([&] { return read_job(""); }), HasSubstr("cannot be opened"));
}

TEST(JobCase, LaysItsKeysOverTheFile)
{
    const std::string text = wall_scene + "[[case]]\nname = \"a\"\nlight.direction = [0, -1, 0.1]\n"
                                          "[case.bias]\nconstant = 0.25\n[[case]]\nname = \"b\"\n";
    const JobFile plain = job_of(text);
    ASSERT_EQ(plain.cases.size(), 2U);
    EXPECT_EQ(plain.cases[0].name, "a");
    ASSERT_EQ(plain.cases[0].overrides.size(), 2U);
    EXPECT_EQ(plain.cases[0].overrides[0].key, "light.direction");
    EXPECT_EQ(plain.cases[0].overrides[0].value, "[0, -1, 0.1]");
    EXPECT_EQ(plain.cases[0].overrides[1].value, "0.25");
    EXPECT_NE(plain.job.bias.constant, 0.25);
    EXPECT_EQ(job_of(text, {}, "a").job.bias.constant, 0.25);
    EXPECT_EQ(resolved_keys(job_of(text, {}, "b").job), resolved_keys(plain.job));
    // A case's keys, given as overrides, make the same job.
    EXPECT_EQ(resolved_keys(job_of(text, plain.cases[0].overrides).job),
              resolved_keys(job_of(text, {}, "a").job));
}

TEST(JobCase, RefusesUnknownNamesNamingTheNearest)
{
    const std::string text = wall_scene + "[[case]]\nname = \"noon\"\n[[case]]\nname = \"dusk\"\n";
    EXPECT_EQ(refusal(text, {}, "dust"), "job.toml: no case \"dust\"; the nearest is \"dusk\"");
    EXPECT_EQ(refusal(wall_scene, {}, "noon"),
              "job.toml: no case \"noon\": the job defines no [[case]]");
}

TEST(JobCase, RefusesCasesWithoutANameOfTheirOwn)
{
    EXPECT_THAT(refusal(wall_scene + "[[case]]\nbias.slope = 1\n"), HasSubstr("has no name"));
    EXPECT_THAT(refusal(wall_scene + "[[case]]\nname = \"\"\n"),
                HasSubstr("[[case]] name = \"\": must"));
    EXPECT_THAT(refusal(wall_scene + "[[case]]\nname = 3\n"),
                HasSubstr("[[case]] name = 3: must be"));
    EXPECT_THAT(refusal(wall_scene + "[[case]]\nname = \"a\"\n[[case]]\nname = \"a\"\n"),
                HasSubstr("[[case]] name = \"a\": two cases of that name"));
    EXPECT_THAT(refusal(wall_scene + "[case]\nname = \"a\"\n"), HasSubstr("each headed [[case]]"));
    EXPECT_THAT(refusal("case = [1]\n"), HasSubstr("must be a table with a name"));
}

TEST(JobCase, HoldsItsKeysAgainstTheirRangesThoughItIsNotChosen)
{
    EXPECT_EQ(refusal(wall_scene + "[[case]]\nname = \"a\"\nbias.slope = nan\n"),
              "job.toml:5: [[case]] \"a\": bias.slope = nan: must be a number from -1000 to 1000, "
              "0 or at least 1.18e-38 in size (not subnormal)");
    EXPECT_THAT(refusal(wall_scene + "[[case]]\nname = \"a\"\nbias.slop = 1\n"),
                HasSubstr("unknown key \"bias.slop\"; the nearest is bias.slope"));
}

TEST(JobOverride, TakesTomlValuesAndBareWords)
{
    const Job job = builtin_job("wall", {{"lookup.filter", "pcf7"},
                                         {"lookup.outside", "\"clamp\""},
                                         {"scene.no_cast", "[\"wall\"]"},
                                         {"light.direction", "[0,-1,0.5]"},
                                         {"bias.slope", "1e-3"},
                                         {"shadow_map.reversed", "true"}})
                        .job;
    EXPECT_EQ(job.lookup.filter, Filter::pcf7);
    EXPECT_EQ(job.lookup.outside, Outside::clamp);
    EXPECT_THAT(job.scene.no_cast, ElementsAre("wall"));
    EXPECT_EQ(job.light->direction, Vec3d(0, -1, 0.5));
    EXPECT_EQ(job.bias.slope, 1e-3);
    EXPECT_TRUE(job.shadow_map.frustum.reversed);
    EXPECT_EQ(builtin_job("wall", {{"scene.file", "models/my chair.obj"}}).job.scene.file,
              "models/my chair.obj");
}

TEST(JobOverride, IsNamedInItsErrors)
{
    const auto message = [](const std::string& key, const std::string& value) {
        return error_of([&] { return builtin_job("wall", {{key, value}}); });
    };
    EXPECT_EQ(message("shadow_map.resolution", "12abc"),
              "--set shadow_map.resolution=12abc: must be an integer from 1 to 16384");
    EXPECT_EQ(message("shadow_map.resoluton", "12"),
              "--set shadow_map.resoluton=12: unknown key; the nearest is shadow_map.resolution");
    EXPECT_THAT(message("lookup.filter", "linaer"), EndsWith("; the nearest is \"linear\""));
    for (const std::string value : {"", "[1, 2", "{", "\"pcf3", "'"}) {
        EXPECT_THAT(message("lookup.filter", value), HasSubstr("not a TOML value")) << value;
    }
}

TEST(JobOverride, CannotSmuggleInAnotherKey)
{
    EXPECT_THAT(error_of([] {
                    return builtin_job("wall", {{"bias.slope", "1\nbias.normal_texels = 2"}});
                }),
                HasSubstr("--set bias.slope=1?bias.normal_texels = 2: must be a number"));
}

TEST(BuiltinJob, RefusesUnknownNamesNamingTheNearest)
{
    const std::string message = error_of([] { return builtin_job("wal"); });
    EXPECT_THAT(message, StartsWith("--builtin wal: must be one of "));
    EXPECT_THAT(message, HasSubstr("the nearest is \"wall\""));
}

TEST(CommentedJobFile, IsTheBuiltInsOwnJob)
{
    const std::string text = commented_job_file();
    EXPECT_EQ(resolved_keys(job_of(text).job), resolved_keys(builtin_job("sphere-cube").job));
}

TEST(CommentedJobFile, DescribesEveryKeyWithItsRangeAndDefault)
{
    const std::string text = commented_job_file();
    for (const Key& key : own_keys()->rows()) {
        const bool is_parameter = std::count(key.name.begin(), key.name.end(), '.') == 2;
        if (is_parameter && !key.name.starts_with("scene.sphere-cube.")) {
            continue;
        }
        const std::string default_note =
            key.default_text.empty() ? "" : "; default " + key.default_text;
        EXPECT_THAT(text, HasSubstr("\n# " + key.description + "\n#   " + key.range_text +
                                    default_note + "\n"))
            << key.name;
    }
}

TEST(LoadScene, BuildsTheBuiltInWithItsParametersGroundAndRoles)
{
    Job job = builtin_job("wall", {{"scene.wall.thickness_m", "0.5"},
                                   {"scene.no_cast", "[\"wall\"]"},
                                   {"scene.no_receive", "[\"ground\"]"}})
                  .job;
    const TriangleScene thick = load_scene(job.scene).scene;
    job.scene.parameters["thickness_m"] = 0.0;
    const TriangleScene sheet = load_scene(job.scene).scene;
    EXPECT_GT(thick.triangles.size(), sheet.triangles.size());
    ASSERT_EQ(sheet.objects.size(), 2U);
    for (const Object& object : sheet.objects) {
        EXPECT_EQ(object.casts, object.name != "wall");
        EXPECT_EQ(object.receives, object.name != "ground");
    }
    job.scene.ground = true;
    job.scene.no_cast.clear();
    job.scene.no_receive.clear();
    EXPECT_EQ(load_scene(job.scene).scene.triangles.size(), sheet.triangles.size() + 2);
}

TEST(LoadScene, ReadsAFile)
{
    write_job("o tri\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "tri.obj");
    const Job job = job_of("scene.file = \"tri.obj\"\nscene.ground = true\n").job;
    EXPECT_EQ(load_scene(job.scene).scene.triangles.size(), 3U); // and two of the ground
}

TEST(LoadScene, RefusesNoSceneTwoScenesAndUnknownObjects)
{
    EXPECT_THROW((void)load_scene(SceneSettings{}), InputError);
    SceneSettings settings;
    settings.builtin = "wall";
    settings.no_cast = {"wal"};
    EXPECT_THAT(error_of([&] { return load_scene(settings); }), HasSubstr("wall"));
    settings.file = "a.obj";
    EXPECT_THAT(error_of([&] { return load_scene(settings); }), HasSubstr("exactly one of"));
}

} // namespace
} // namespace gnomon::scene::test
