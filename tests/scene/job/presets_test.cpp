// Presets: their files, their place among the layers, and errors.

#include "job_fixture.hpp"

#include "methods/key_table.hpp"
#include "scene/job/file.hpp"
#include "scene/job/presets/presets.hpp"
#include "scene/job/source.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace gnomon::scene::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string spot_scene = "scene.builtin = \"sphere-plane\"\n";
const std::string sun_scene = "scene.builtin = \"yard\"\n";

const Keys& keys = methods::key_table();

JobSource source_of_preset(std::string_view preset)
{
    return preset_job_source(preset, {}, keys);
}

Job preset_job(std::string_view preset, const std::vector<Override>& overrides = {})
{
    return job_of(preset_job_source(preset, overrides, keys)).job;
}

JobFile read_with_presets(const std::string& text, const std::vector<Override>& overrides = {},
                          std::string_view case_name = {})
{
    return job_of(text, overrides, case_name, keys);
}

std::string refusal_with_presets(const std::string& text,
                                 const std::vector<Override>& overrides = {})
{
    return refusal(text, overrides, {}, keys);
}

/// A built-in scene with a light of the type.
std::string scene_of(LightType type)
{
    return type == LightType::spot ? spot_scene : sun_scene;
}

/// The message with which a preset's text is refused.
std::string preset_refusal(const std::string& text)
{
    return error_of([&] { return read_preset(*keys, "mine", text); });
}

const std::string whole_preset = "kind = \"engine\"\nsentence = \"s\"\nsource = \"d\"\n"
                                 "lights = [\"spot\"]\nown_bias = \"b\"\ncannot = [\"c\"]\n"
                                 "[job]\nbias.constant = 0.5\n";

TEST(Presets, AreSixLessonsAndFourteenEngines)
{
    const auto count = [](PresetKind kind) {
        return std::ranges::count(presets(*keys), kind, &Preset::kind);
    };
    EXPECT_EQ(count(PresetKind::lesson), 6); // one of them in two formats
    EXPECT_EQ(count(PresetKind::engine), 14);
}

TEST(Presets, SayWhatTheyAreWhereFromAndWhatIsMissing)
{
    std::set<std::string> names;
    for (const Preset& preset : presets(*keys)) {
        EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
        EXPECT_EQ(preset.sentence.find('\n'), std::string::npos) << preset.name;
        EXPECT_FALSE(preset.cannot.empty()) << preset.name;
        EXPECT_EQ(preset.own_scene.empty(), preset.kind == PresetKind::engine) << preset.name;
    }
}

TEST(Presets, OfEnginesSayHowTheirUsersSetThem)
{
    std::vector<std::string> with_settings;
    for (const Preset& preset : presets(*keys)) {
        if (preset.engine) {
            with_settings.push_back(preset.name);
        }
    }
    EXPECT_EQ(with_settings, engine_names());
    EXPECT_EQ(with_settings.size(), 13U) << "all but mjp-shadows, which is a sample";
}

TEST(Presets, OfEnginesAreFoundByTheirAliasesInAnyCase)
{
    const auto found = [](std::string_view name) { return find_engine(*keys, name, "").name; };
    EXPECT_EQ(found("three"), "three");
    EXPECT_EQ(found("three.js"), "three");
    EXPECT_EQ(found("ThreeJS"), "three");
    EXPECT_EQ(found("URP"), "unity");
    EXPECT_EQ(found("UE5"), "unreal");
    EXPECT_EQ(found("Godot4"), "godot");
    EXPECT_EQ(found("Qt-Quick-3D"), "qtquick3d");
    EXPECT_EQ(found("babylonjs"), "babylon");
    EXPECT_EQ(found("OSG"), "openscenegraph");
    EXPECT_EQ(found("CesiumJS"), "cesium");
}

TEST(Presets, OfEnginesHaveAliasesInLowerCaseThatNoOtherHas)
{
    std::set<std::string> names;
    for (const Preset& preset : presets(*keys)) {
        EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    }
    for (const Preset& preset : presets(*keys)) {
        for (const std::string& alias : preset.engine.value_or(Engine{}).aliases) {
            EXPECT_TRUE(names.insert(alias).second) << alias;
            EXPECT_EQ(alias, lower_case(alias));
        }
    }
}

TEST(Presets, OfEnginesAreAllListedForAnUnknownName)
{
    EXPECT_THAT(error_of([] { (void)find_engine(*keys, "thre", "--engine thre"); }),
                AllOf(HasSubstr("--engine thre: unknown engine; the nearest is three (of filament"),
                      HasSubstr(", three (three.js, threejs), "),
                      HasSubstr(", unity (urp, unity-urp), ")));
    EXPECT_THAT(error_of([] { (void)find_engine(*keys, "lesson-game", "e"); }),
                HasSubstr("unknown engine")); // a preset, but not an engine's
}

TEST(Presets, DecideTheSystemAndLeaveSceneCameraAndLightToTheirOwnScene)
{
    for (const Preset& preset : presets(*keys)) {
        for (const Setting& setting : preset.job) {
            const std::string& key = setting.spec->name;
            EXPECT_TRUE(is_system_key(key) || key.starts_with("shadow_map."))
                << preset.name << ": " << key;
        }
        for (const Setting& setting : preset.own_scene) {
            EXPECT_FALSE(is_system_key(setting.spec->name))
                << preset.name << ": " << setting.spec->name;
        }
    }
}

TEST(Presets, ResolveUnderEveryLightThatTheyAreFor)
{
    for (const Preset& preset : presets(*keys)) {
        for (const LightType type : preset.lights) {
            const Job job =
                read_with_presets(fmt::format("preset = \"{}\"\n{}", preset.name, scene_of(type)))
                    .job;
            for (const Setting& setting : preset.job) {
                const auto value = setting.spec->get(job);
                ASSERT_TRUE(value) << preset.name << ": " << setting.spec->name;
                EXPECT_EQ(to_toml(*value), to_toml(setting.value)) << preset.name;
            }
        }
    }
}

TEST(Presets, OfLessonsResolveWithTheirOwnScene)
{
    EXPECT_EQ(preset_job("lesson-textbook").scene.builtin, "two-distances");
    EXPECT_EQ(preset_job("lesson-lecture").scene.builtin, "sphere-cube");
    EXPECT_EQ(preset_job("lesson-opengl-notes").scene.builtin, "yard");
    EXPECT_EQ(preset_job("lesson-game").scene.builtin, "playground");
    EXPECT_EQ(preset_job("lesson-webgl").scene.builtin, "sphere-plane");
}

TEST(Presets, LieAboveTheBuiltInAndBeneathTheFile)
{
    const Job job = read_with_presets("preset = \"lesson-webgl\"\n" + spot_scene +
                                          "lookup.outside = \"clamp\"\nshadow_map.far = 12\n",
                                      {{"shadow_map.resolution", "64"}})
                        .job;
    EXPECT_EQ(job.shadow_map.depth_format.kind, DepthFormat::Kind::d32);
    EXPECT_EQ(job.lookup.outside, Outside::clamp);
    EXPECT_EQ(job.shadow_map.frustum.far_m, 12);
    EXPECT_EQ(job.shadow_map.resolution_texels, 64);
}

TEST(Presets, LeaveNothingOfTheBuiltInsSystem)
{
    // By itself the scene has a bias of 0.006, and planes at 0.5 and 10, which are no part of it.
    const Job job = read_with_presets("preset = \"three\"\n" + spot_scene).job;
    EXPECT_EQ(job.bias.constant, 0);
    EXPECT_EQ(job.shadow_map.frustum.near_m, 0.5);
    EXPECT_EQ(read_with_presets("preset = \"three\"\n" + spot_scene).job.shadow_map.depth_format,
              DepthFormat{});
}

TEST(Presets, LeaveTheirOwnSceneWhereTheJobNamesOne)
{
    const Job job =
        read_with_presets("preset = \"lesson-opengl-notes\"\nscene.builtin = \"wall\"\n").job;
    EXPECT_EQ(job.scene.builtin, "wall");
    EXPECT_NE(job.shadow_map.frustum.fit, Fit::fixed);
    EXPECT_EQ(job.lookup.filter, Filter::pcf3);
}

TEST(Presets, AreReplacedByTheCommandLines)
{
    const JobSource source = read_job_source(write_job("preset = \"lesson-webgl\"\n" + spot_scene),
                                             {}, "lesson-lecture", keys);
    EXPECT_EQ(job_of(source).job.bias.constant, 0.1);
}

TEST(Presets, AreLaidUnderCases)
{
    const std::string text = "preset = \"lesson-lecture\"\n" + spot_scene +
                             "[[case]]\nname = \"less\"\nbias.constant = 0.01\n";
    EXPECT_EQ(read_with_presets(text).job.bias.constant, 0.1);
    EXPECT_EQ(read_with_presets(text, {}, "less").job.bias.constant, 0.01);
}

TEST(Presets, AreLaidUnderEachOfSeveralLights)
{
    const JobSource source = read_job_source(
        write_job("preset = \"lesson-lecture\"\n" + spot_scene +
                  "[[lights]]\nname = \"a\"\ntype = \"spot\"\nposition = [1, 5, 1]\n"
                  "target = [0, 0, 0]\n[[lights]]\nname = \"b\"\ntype = \"spot\"\n"
                  "position = [2, 5, 1]\ntarget = [0, 0, 0]\nbias.constant = 0.2\n"),
        {}, {}, keys);
    const auto jobs = light_jobs(source);
    EXPECT_EQ(jobs.at(0).job.bias.constant, 0.1);
    EXPECT_EQ(jobs.at(1).job.bias.constant, 0.2);
    EXPECT_EQ(make_job(only_light(source, "a")).bias.constant, 0.1);
}

TEST(Presets, StandAmongTheGivenKeys)
{
    const JobSource source = source_of_preset("lesson-lecture");
    const auto given = given_keys(source);
    EXPECT_THAT(given,
                testing::Contains(std::pair<std::string, std::string>{"bias.constant", "0.1"}));
}

TEST(Presets, TakeThePlaceOfAJobsOwnSystem)
{
    const JobSource source =
        read_job_source(write_job(spot_scene + "bias.constant = 0.3\nlookup.filter = \"pcf5\"\n"
                                               "image.width = 50\nshadow_map.near = 1\n"),
                        {{"shadow_map.resolution", "77"}}, {}, keys);
    const Job job =
        make_job(with_preset(source, nullptr, find_preset(*keys, "lesson-lecture", "here")));
    EXPECT_EQ(job.bias.constant, 0.1);
    EXPECT_EQ(job.lookup.filter, Filter::nearest);
    EXPECT_EQ(job.image.width_px, 50);
    EXPECT_EQ(job.shadow_map.frustum.near_m, 1);
    EXPECT_EQ(job.shadow_map.resolution_texels, 77);
}

TEST(Presets, OfCascadesTakeThePlaceOfAFixedFit)
{
    const JobSource source =
        read_job_source(write_job(sun_scene + "shadow_map.fit = \"fixed\"\n"), {}, {}, keys);
    const Job job = make_job(with_preset(source, nullptr, find_preset(*keys, "bevy", "here")));
    EXPECT_EQ(map_layout(job), MapLayout::cascades);
}

TEST(Presets, AreWrittenOutAsJobFiles)
{
    for (const Preset& preset : presets(*keys)) {
        const Job job = read_with_presets(commented_job_file(preset.name, keys)).job;
        for (const Setting& setting : preset.job) {
            const auto value = setting.spec->get(job);
            ASSERT_TRUE(value) << preset.name << ": " << setting.spec->name;
            EXPECT_EQ(to_toml(*value), to_toml(setting.value)) << preset.name;
        }
    }
    EXPECT_THAT(error_of([] { return commented_job_file("bevvy", keys); }),
                HasSubstr("the nearest is bevy"));
}

TEST(Presets, NameTheNearestWhereThereIsNoneOfTheName)
{
    EXPECT_EQ(refusal_with_presets("preset = \"bevvy\"\n" + sun_scene),
              "job.toml:1: preset = \"bevvy\": no preset of that name; the nearest is bevy "
              "(`gnomon presets`)");
    EXPECT_EQ(error_of([] { return source_of_preset("lesson-webg"); }),
              "--preset lesson-webg: no preset of that name; the nearest is lesson-webgl (`gnomon "
              "presets`)");
    EXPECT_EQ(refusal_with_presets("preset = 3\n" + sun_scene),
              "job.toml:1: preset = 3: must be the name of a preset (`gnomon presets`)");
}

TEST(Presets, AreRefusedForAnotherLight)
{
    EXPECT_EQ(refusal_with_presets("preset = \"bevy\"\n" + spot_scene),
              "job.toml:1: preset = \"bevy\": it supports a directional light, but the job's is "
              "spot; choose another (`gnomon presets`)");
}

TEST(Presets, AreRefusedForALightWhoseTypeIsLeftOut)
{
    const std::string model = "scene.file = \"a.obj\"\n";
    EXPECT_THAT(refusal_with_presets("preset = \"playcanvas\"\n" + model +
                                     "light.direction = [0, -1, 0]\n"),
                HasSubstr("it supports a spot light, but the job's is directional"));
    EXPECT_EQ(refusal_with_presets("preset = \"playcanvas\"\n" + model),
              "no error"); // the file may have a spot
}

TEST(Presets, OfEnginesNeedAScene)
{
    EXPECT_THAT(error_of([] { return source_of_preset("bevy"); }),
                HasSubstr("--preset bevy: it has no scene of its own"));
}

TEST(Presets, StandAtTheTopOfAJobAlone)
{
    for (const std::string& text : {std::string{"[image]\npreset = \"bevy\"\n"},
                                    std::string{"[[case]]\nname = \"a\"\npreset = \"bevy\"\n"},
                                    std::string{"[sweep]\npreset = [\"bevy\"]\n"},
                                    std::string{"[[lights]]\nname = \"a\"\npreset = \"bevy\"\n"}}) {
        EXPECT_THAT(refusal_with_presets(sun_scene + text),
                    AllOf(HasSubstr("preset"), HasSubstr("at the top of the job file")));
    }
    EXPECT_THAT(refusal_with_presets(sun_scene, {{"preset", "bevy"}}),
                HasSubstr("or give --preset NAME"));
}

TEST(Presets, AreReadFromTheirText)
{
    const Preset preset = read_preset(*keys, "mine", whole_preset);
    EXPECT_EQ(preset.name, "mine");
    EXPECT_TRUE(preset.is_for(LightType::spot));
    EXPECT_FALSE(preset.is_for(LightType::directional));
    ASSERT_EQ(preset.job.size(), 1U);
    EXPECT_EQ(preset.job.front().label, "preset mine: bias.constant = 0.5");
}

TEST(Presets, LayTheirKeysOverThoseOfWhatTheyAreBasedOn)
{
    const Preset base = read_preset(*keys, "base", whole_preset + "lookup.filter = \"pcf3\"\n");
    const Preset preset = read_preset(*keys, "mine", whole_preset, &base);
    ASSERT_EQ(preset.job.size(), 2U);
    EXPECT_EQ(preset.job.front().spec->name, "lookup.filter");
    EXPECT_EQ(base_of_preset("mine", "based_on = \"base\"\n" + whole_preset), "base");
    EXPECT_EQ(base_of_preset("mine", whole_preset), "");
}

TEST(Presets, AreRefusedWhereTheirTextIsNotWhole)
{
    EXPECT_EQ(preset_refusal("kind = \"engine\"\n"), "preset mine: sentence is missing");
    EXPECT_EQ(preset_refusal("more = 1\n"), "preset mine: unknown member more");
    EXPECT_EQ(preset_refusal("kind = \"book\"\n"), "preset mine: there is no kind book");
    EXPECT_EQ(preset_refusal("lights = [\"sun\"]\n"), "preset mine: there is no light sun");
    EXPECT_EQ(preset_refusal("cannot = \"c\"\n"), "preset mine: cannot must be a list of texts");
    EXPECT_THAT(preset_refusal("[job]\nbias.constant = 7\n"),
                HasSubstr("preset mine: bias.constant = 7: must be"));
}

TEST(Presets, AreRefusedWhereTheirEngineIsNotWhole)
{
    const std::string engine = "[engine]\ntitle = \"t\"\nversion = \"1\"\ndocumentation = \"d\"\n"
                               "comment = \"//\"\n";
    const auto with_setting = [&](const std::string& members) {
        return preset_refusal(engine + "[[engine.settings]]\nname = \"n\"\nline = \"n = {}\"\n" +
                              members);
    };
    EXPECT_EQ(preset_refusal("[engine]\ntitle = \"t\"\n"),
              "preset mine: [engine]: version is missing");
    EXPECT_EQ(preset_refusal(engine), "preset mine: [engine]: settings is missing");
    EXPECT_EQ(preset_refusal(engine + "aliases = \"mine\"\n"),
              "preset mine: [engine]: aliases must be a list of names");
    EXPECT_EQ(preset_refusal(engine + "aliases = [1]\n"),
              "preset mine: [engine]: aliases must be a text");
    const std::string where = "preset mine: [[engine.settings]]: ";
    EXPECT_EQ(with_setting(""), where + "key is missing");
    EXPECT_EQ(with_setting("key = \"bias.none\"\n"), where + "there is no key bias.none");
    const std::string key = "key = \"shadow_map.cull\"\n";
    EXPECT_EQ(with_setting(key + "second_key = \"bias.none\"\n"),
              where + "there is no key bias.none");
    EXPECT_EQ(with_setting(key + "times = 0\n"), where + "times must not be 0");
    EXPECT_EQ(with_setting(key + "times = \"a\"\n"), where + "times must be a number");
    EXPECT_EQ(with_setting(key + "words = { none = 1 }\n"), where + "none must be a text");
    EXPECT_EQ(with_setting(key + "default = \"NONE\"\n"),
              where + "default NONE is not among the words");
    EXPECT_EQ(with_setting(key + "where = { unknown = [] }\n"),
              where + "where.unknown must be a key with a list of words");
    EXPECT_EQ(with_setting(key + "more = 1\n"), where + "unknown member more");
}

} // namespace
} // namespace gnomon::scene::test
