// Jobs with several lights: reading, settings per light, and errors.

#include "job_fixture.hpp"

#include "scene/import/scene_file.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/lights.hpp"
#include "scene/job/source.hpp"
#include "scene/job/sweep/sweep_axes.hpp"

#include <fmt/format.h>

namespace gnomon::scene::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string sun_table = "[[lights]]\nname = \"sun\"\ntype = \"directional\"\n"
                              "direction = [0, -1, 0.5]\n";
const std::string lamp_table =
    "[[lights]]\nname = \"lamp-2\"\ntype = \"point\"\nposition = [0, 2, 1]\n";
const std::string two = "[scene]\nbuiltin = \"wall\"\n" + sun_table + lamp_table;

std::vector<LightJob> jobs_of(const std::string& text, const std::vector<Override>& overrides = {},
                              std::string_view case_name = {})
{
    return light_jobs(read_job_source(write_job(text), overrides), case_name);
}

std::string lights_refusal(const std::string& text, const std::vector<Override>& overrides = {})
{
    std::string message = error_of([&] { return jobs_of(text, overrides); });
    const std::string prefix = job_folder().string() + "/";
    return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

std::vector<std::string> names_of(const std::vector<LightJob>& jobs)
{
    std::vector<std::string> names;
    for (const LightJob& job : jobs) {
        names.push_back(job.light);
    }
    return names;
}

TEST(JobLights, AreJobsWithOneLightEach)
{
    const auto jobs = jobs_of(two);
    ASSERT_THAT(names_of(jobs), ElementsAre("sun", "lamp-2"));
    EXPECT_EQ(jobs[0].job.light->type, LightType::directional);
    EXPECT_EQ(jobs[1].job.light->type, LightType::point);
    // Equals the job with only that light.
    const auto alone = job_of("[scene]\nbuiltin = \"wall\"\n[light]\ntype = \"point\"\n"
                              "position = [0, 2, 1]\n");
    EXPECT_EQ(resolved_keys(jobs[1].job), resolved_keys(alone.job));
}

TEST(JobLights, OneLightNeedsNoName)
{
    const auto jobs = jobs_of(wall + "light.direction = [0, -1, 0]\n");
    ASSERT_EQ(jobs.size(), 1U);
    EXPECT_EQ(jobs[0].light, "");
}

TEST(JobLights, MayHaveTheirOwnOfEveryTable)
{
    const std::string text = two + "shadow_map.resolution = 64\nbias.slope = 0.25\n"
                                   "lookup.filter = \"pcf3\"\nbias.constant = 0.125\n"
                                   "[shadow_map]\nresolution = 512\n[bias]\nslope = 0.5\n";
    const auto jobs = jobs_of(text);
    EXPECT_EQ(jobs[0].job.shadow_map.resolution_texels, 512);
    EXPECT_EQ(jobs[1].job.shadow_map.resolution_texels, 64);
    EXPECT_EQ(jobs[0].job.bias.slope, 0.5);
    EXPECT_EQ(jobs[1].job.bias.slope, 0.25);
    EXPECT_EQ(jobs[0].job.lookup.filter, Filter::nearest);
    EXPECT_EQ(jobs[1].job.lookup.filter, Filter::pcf3);
    EXPECT_EQ(jobs[0].job.bias.constant, job_of(wall).job.bias.constant);
    EXPECT_EQ(jobs[1].job.bias.constant, 0.125);
}

/// A stronger layer wins, for all lights or one; within a layer, settings for one light win.
TEST(JobLights, LayersComeBeforeLights)
{
    const std::string text = two + "bias.slope = 0.25\n[bias]\nslope = 0.5\n"
                                   "[[case]]\nname = \"noon\"\nbias.slope = 1\n"
                                   "lights.sun.bias.slope = 2\n";
    const auto slopes = [&](const std::vector<Override>& overrides, std::string_view case_name) {
        const auto jobs = jobs_of(text, overrides, case_name);
        return std::vector{jobs[0].job.bias.slope, jobs[1].job.bias.slope};
    };
    EXPECT_THAT(slopes({}, ""), ElementsAre(0.5, 0.25));
    EXPECT_THAT(slopes({}, "noon"), ElementsAre(2, 1));
    EXPECT_THAT(slopes({{"bias.slope", "4"}}, ""), ElementsAre(4, 4));
    EXPECT_THAT(slopes({{"lights.lamp-2.bias.slope", "4"}}, "noon"), ElementsAre(2, 4));
    EXPECT_THAT(slopes({{"bias.slope", "8"}, {"lights.sun.bias.slope", "4"}}, "noon"),
                ElementsAre(4, 8));
}

TEST(JobLights, ReplaceWhatOtherTypesOfLightNeed)
{
    const auto jobs = jobs_of(two, {{"lights.sun.type", "spot"},
                                    {"lights.sun.position", "[1, 2, 3]"},
                                    {"lights.sun.target", "[0, 0, 0]"}});
    EXPECT_EQ(jobs[0].job.light->type, LightType::spot);
    EXPECT_FALSE(jobs[0].job.light->direction);
}

/// All lights share their receivers, which is impossible for receivers with light coordinates.
TEST(JobLights, AreLookedUpAtThePixel)
{
    for (const LightJob& job : jobs_of(two)) {
        EXPECT_EQ(lookup_position(job.job), LookupPosition::pixel) << job.light;
    }
    EXPECT_EQ(lights_refusal(two, {{"lookup.position", "vertex"}}),
              "--set lookup.position=vertex: must be \"pixel\" with several lights, because they "
              "share their receivers; remove it, or choose one light with --light");
    EXPECT_THAT(lights_refusal(two, {{"lights.sun.lookup.position", "vertex"}}),
                HasSubstr("must be \"pixel\" with several lights"));
    const auto alone = [&](const std::vector<Override>& overrides) {
        return make_job(only_light(read_job_source(write_job(two), overrides), "sun"));
    };
    EXPECT_EQ(lookup_position(alone({})), LookupPosition::pixel);
    EXPECT_EQ(lookup_position(alone({{"lookup.position", "vertex"}})), LookupPosition::vertex);
}

TEST(JobLights, OneOfThemIsAJobOfItsOwn)
{
    const JobSource source = read_job_source(
        write_job(two + "bias.slope = 0.25\n[sweep]\n\"bias.slope\" = [1, 2]\n"
                        "\"lights.lamp-2.bias.slope\" = [3, 4]\n\"lights.sun.bias.slope\" = [5]\n"),
        {});
    const JobSource lamp_alone = only_light(source, "lamp-2");
    EXPECT_EQ(resolved_keys(make_job(lamp_alone)),
              resolved_keys(make_job(source, nullptr, {}, "lamp-2")));
    ASSERT_EQ(lamp_alone.sweep.axes.size(), 1U);
    EXPECT_EQ(lamp_alone.sweep.axes[0].key, "bias.slope");
    EXPECT_THAT(lamp_alone.sweep.axes[0].values, ElementsAre("3", "4"));
    EXPECT_THAT(error_of([&] { return only_light(source, "lamp"); }),
                HasSubstr("no light \"lamp\"; there are sun, lamp-2"));
    EXPECT_THAT(error_of([&] { return make_job(source); }),
                HasSubstr("the job has several lights: choose one with --light, sun or lamp-2"));
}

TEST(JobLights, RefuseNamesThatAreNone)
{
    const std::string head = "[scene]\nbuiltin = \"wall\"\n";
    for (const char* const name : {"\"a b\"", "\"\"", "\"Sun\"", "\"sun.\"", "\"ß\"", "3"}) {
        EXPECT_EQ(lights_refusal(head + fmt::format("[[lights]]\nname = {}\n", name)),
                  fmt::format("job.toml:4: [[lights]] name = {}: must be made of the letters a to "
                              "z, digits, _ and -, 64 at most",
                              name));
    }
    EXPECT_EQ(lights_refusal(two + sun_table),
              "job.toml:12: [[lights]] name = \"sun\": two lights of that name; rename one");
    EXPECT_EQ(lights_refusal(head + "[[lights]]\ntype = \"point\"\n"),
              "job.toml:3: [[lights]]: has no name; give it a name of its own");
}

TEST(JobLights, RefuseWhatIsNoListOfTables)
{
    for (const char* const value : {"3", "[]", "{sun = {type = \"point\"}}"}) {
        EXPECT_EQ(lights_refusal(fmt::format("lights = {}\n{}", value, wall)),
                  "job.toml:1: lights: must be tables, each headed [[lights]]");
    }
    EXPECT_EQ(lights_refusal("lights = [3]\n" + wall),
              "job.toml:1: [[lights]]: must be a table with a name and keys of [light]");
    std::string many = "[scene]\nbuiltin = \"wall\"\n";
    for (int i = 0; i < 65; ++i) {
        many += fmt::format("[[lights]]\nname = \"l{}\"\n", i);
    }
    EXPECT_EQ(lights_refusal(many), "job.toml:3: [[lights]]: 65 lights; at most 64");
}

TEST(JobLights, RefuseKeysThatALightCannotHave)
{
    EXPECT_EQ(lights_refusal(two + "resolutio = 3\n"),
              "job.toml:11: unknown key \"lights.lamp-2.resolutio\"; the nearest is "
              "lights.lamp-2.position");
    EXPECT_THAT(lights_refusal(two + "shadow_map.resolutio = 3\n"),
                HasSubstr("the nearest is lights.lamp-2.shadow_map.resolution"));
    EXPECT_THAT(lights_refusal(two + "image.width = 3\n"),
                StartsWith("job.toml:11: unknown table"));
    EXPECT_THAT(lights_refusal(two + "light.position = [0, 0, 0]\n"),
                StartsWith("job.toml:11: unknown table"));
    EXPECT_EQ(lights_refusal(two + "position = [1, 2, 3]\n").substr(0, 12), "job.toml:11:");
}

TEST(JobLights, RefuseALightWithoutAName)
{
    for (const char* const key : {"lights..bias.slope", "lights.a b.bias.slope", "lights..type"}) {
        EXPECT_THAT(lights_refusal(two, {{key, "1"}}), HasSubstr("unknown key")) << key;
    }
    EXPECT_THAT(lights_refusal(two + "[[case]]\nname = \"noon\"\nlights.\"\".bias.slope = 3\n"),
                HasSubstr("unknown"));
    EXPECT_THAT(space_refusal(two, {"lights..bias.slope=0,1"}), HasSubstr("unknown key"));
}

TEST(JobLights, RefuseUnknownLightsInWhatIsNotLookedAt)
{
    EXPECT_THAT(lights_refusal(two + "[[case]]\nname = \"noon\"\nlights.moon.bias.slope = 3\n"),
                HasSubstr("the job has no light of that name; the nearest is sun"));
    const JobSource source =
        read_job_source(write_job(two + "[sweep]\n\"lights.moon.bias.slope\" = [1, 2]\n"), {});
    EXPECT_THAT(error_of([&] { return only_light(source, "sun"); }),
                HasSubstr("[sweep] lights.moon.bias.slope: the job has no light of that name"));
}

TEST(JobLights, RefuseWhatIsSaidOfNoLightOrOfAll)
{
    EXPECT_EQ(lights_refusal(two, {{"light.direction", "[0, -1, 0]"}}),
              "--set light.direction=[0, -1, 0]: the job has several lights; set it for one of "
              "them, e.g. lights.sun.direction");
    EXPECT_THAT(lights_refusal(two + "[light]\ntype = \"point\"\n"),
                HasSubstr("the job has several lights; set it for one of them, e.g. "
                          "lights.sun.type"));
    EXPECT_EQ(lights_refusal(two, {{"lights.lamp.bias.slope", "1"}}),
              "--set lights.lamp.bias.slope=1: the job has no light of that name; the nearest is "
              "lamp-2");
    EXPECT_EQ(lights_refusal(wall, {{"lights.sun.bias.slope", "1"}}),
              "--set lights.sun.bias.slope=1: the job has no [[lights]]; remove it, or set "
              "bias.slope for its only light");
    EXPECT_EQ(lights_refusal(two, {{"lights.sun.bias.slop", "1"}}),
              "--set lights.sun.bias.slop=1: unknown key; the nearest is lights.sun.bias.slope");
}

FileLight lamp_named(const std::string& name)
{
    FileLight light{name, {}};
    light.settings.type = LightType::point;
    light.settings.position = Vec3d{1, 2, 3};
    return light;
}

TEST(LightsOfAFile, AreNamedAfterTheirNodes)
{
    const LightTables tables = light_tables_of(
        *own_keys(),
        {lamp_named("Key Light.001"), lamp_named("lamp"), lamp_named("Lamp"), lamp_named("Lamp"),
         lamp_named("Öl"), lamp_named(""), lamp_named("..."), lamp_named("-lamp_-")},
        "a.glb");
    EXPECT_THAT(tables.names, ElementsAre("key-light-001", "lamp", "lamp-2", "lamp-3", "l", "light",
                                          "light-2", "-lamp_"));
    for (const std::string& name : tables.names) {
        EXPECT_TRUE(is_light_name(name)) << name;
    }
    ASSERT_GE(tables.layer.size(), 2U);
    EXPECT_EQ(tables.layer[0].label, "a.glb: lights.key-light-001.type = \"point\"");
    EXPECT_EQ(tables.layer[0].light, "key-light-001");
}

TEST(LightsOfAFile, AreRefusedWhereThereAreNoneOrTooMany)
{
    EXPECT_EQ(error_of([] { return light_tables_of(*own_keys(), {}, "a.glb"); }),
              "a.glb: scene.lights = \"all\": the file has no light that can have a shadow map; "
              "remove the key, or give lights under [[lights]]");
    EXPECT_EQ(error_of([] {
                  return light_tables_of(*own_keys(), std::vector<FileLight>(65, lamp_named("l")),
                                         "a.glb");
              }),
              "a.glb: scene.lights = \"all\": the file has 65 lights; at most 64 are supported: "
              "give some under [[lights]]");
}

TEST(LightsOfAFile, AreOfASceneFile)
{
    EXPECT_EQ(
        lights_refusal(wall, {{"scene.lights", "all"}}),
        "--set scene.lights=all: only a scene.file can bring lights; remove it, or give lights "
        "under [[lights]]");
    EXPECT_EQ(lights_refusal(wall, {{"scene.lights", "first"}}), "no error");
    EXPECT_THAT(lights_refusal(wall, {{"scene.lights", "some"}}),
                HasSubstr("must be one of first, all"));
    const std::string a_case = wall + "[[case]]\nname = \"all\"\nscene.lights = \"all\"\n";
    EXPECT_THAT(error_of([&] { return jobs_of(a_case, {}, "all"); }),
                HasSubstr("scene.lights = \"all\" takes the lights of one file; set both, its unit "
                          "and its up axis outside of cases and axes"));
}

TEST(SweepOfLights, VariesThemFastest)
{
    const SweepSpace space = space_of(two + "[sweep]\n\"bias.slope\" = [1, 2]\n");
    ASSERT_EQ(space.size(), 4U);
    std::vector<std::string> points;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        const SweepPoint point = space.at(i);
        points.push_back(
            fmt::format("{} {}", space.light_name(point), space.job(point).bias.slope));
    }
    EXPECT_THAT(points, ElementsAre("sun 1", "lamp-2 1", "sun 2", "lamp-2 2"));
    EXPECT_THAT(space.distinctions(), ElementsAre("bias.slope", "light"));
}

TEST(SweepOfLights, OneLightsAxesChangeNoOthersJob)
{
    const SweepSpace space =
        space_of(two + "[sweep]\n\"lights.sun.shadow_map.resolution\" = [64, 128]\n"
                       "\"lights.lamp-2.bias.constant\" = [0.1, 0.2]\n");
    ASSERT_EQ(space.size(), 8U);
    std::set<std::uint64_t> sun_groups;
    std::set<std::uint64_t> lamp_groups;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        const SweepPoint point = space.at(i);
        const bool is_sun = space.light_name(point) == "sun";
        (is_sun ? sun_groups : lamp_groups).insert(space.curve_group(point));
        const Job job = space.job(point);
        EXPECT_EQ(job.shadow_map.resolution_texels,
                  is_sun ? (point.values[0] == 0 ? 64 : 128) : 4096);
        Job biased = job;
        biased.bias.constant = 0.5;
        space.set_constant_bias(biased, point);
        EXPECT_EQ(biased.bias.constant, is_sun ? 0.5 : (point.values[1] == 0 ? 0.1 : 0.2));
    }
    EXPECT_EQ(sun_groups.size(), 2U);
    EXPECT_EQ(lamp_groups.size(), 1U); // one curve answers for both biases
    const auto values = space.light_values(space.at(7));
    EXPECT_THAT(values, ElementsAre(testing::Pair("light", "\"lamp-2\""),
                                    testing::Pair("lights.sun.shadow_map.resolution", "128"),
                                    testing::Pair("lights.lamp-2.bias.constant", "0.2")));
}

TEST(SweepOfLights, ZippedAxesGroupByTheLightTheyAreOf)
{
    const SweepSpace space =
        space_of(two + "[sweep]\nmode = \"zip\"\n"
                       "\"lights.sun.shadow_map.resolution\" = [64, 128, 128]\n"
                       "\"lights.lamp-2.shadow_map.resolution\" = [32, 32, 16]\n");
    std::vector<std::uint64_t> sun_groups;
    std::vector<std::uint64_t> lamp_groups;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        const SweepPoint point = space.at(i);
        (point.light_index == 0 ? sun_groups : lamp_groups).push_back(space.curve_group(point));
    }
    ASSERT_EQ(sun_groups.size(), 3U);
    EXPECT_NE(sun_groups[0], sun_groups[1]);
    EXPECT_EQ(sun_groups[1], sun_groups[2]);
    EXPECT_EQ(lamp_groups[0], lamp_groups[1]);
    EXPECT_NE(lamp_groups[1], lamp_groups[2]);
}

TEST(SweepOfLights, ASampleKeepsAllLights)
{
    const SweepSpace space = space_of(two + "[sweep]\nsample = 3\n"
                                            "\"bias.slope\" = {from = 0, to = 9, count = 10}\n");
    ASSERT_EQ(space.size(), 6U);
    for (std::uint64_t i = 0; i < 6; i += 2) {
        EXPECT_EQ(space.at(i).values, space.at(i + 1).values);
        EXPECT_NE(space.light_name(space.at(i)), space.light_name(space.at(i + 1)));
    }
}

TEST(SweepOfLights, ArgumentsMayNameTheOnlyLight)
{
    EXPECT_EQ(axis_argument_of_light(*own_keys(), "lights.sun.bias.slope=[0, 1]", "sun"),
              "bias.slope=[0, 1]");
    EXPECT_EQ(axis_argument_of_light(*own_keys(), "lights.sun.type=spot", "sun"),
              "light.type=spot");
    for (const std::string argument :
         {"lights.sun.bias.slope=0", "bias.slope=0", "bias.slope", ""}) {
        EXPECT_EQ(axis_argument_of_light(*own_keys(), argument, "lamp"), argument);
    }
}

TEST(SweepOfLights, RefusesAxesThatAreSetBelow)
{
    EXPECT_THAT(space_refusal(two + "[sweep]\n\"lights.moon.bias.slope\" = [1, 2]\n"),
                HasSubstr("the job has no light of that name; the nearest is sun"));
    EXPECT_THAT(space_refusal(two, {"bias.slope=1,2"}, {}, {{"lights.sun.bias.slope", "4"}}),
                StartsWith("--set bias.slope: bias.slope is an axis of the sweep"));
    EXPECT_EQ(space_refusal(two, {"lights.sun.bias.slope=1,2"}, {}, {{"bias.slope", "4"}}),
              "no error");
    EXPECT_EQ(
        space_refusal(two, {"lights.sun.bias.slope=1,2", "bias.slope=3,4"}),
        "job.toml: [sweep] lights.sun.bias.slope: bias.slope is an axis, too; keep one of the "
        "two, or give each light its own");
}

} // namespace
} // namespace gnomon::scene::test
