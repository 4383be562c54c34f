// Key tables with keys that higher layers add, here of made-up methods.

#include "scene/job/keys/key_table.hpp"

#include "job_fixture.hpp"

#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/source.hpp"
#include "scene/load/load_scene.hpp"
#include "scene/view/view.hpp"

#include <stdexcept>

namespace gnomon::scene::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Key width_key()
{
    return added_key(
        make_key("method.width", "texels across", "", only(Stage::prefilter), "texels"),
        IntegerDomain{1, 9, 2}, std::int64_t{5}, {}, {"vsm", "moments"});
}
Key content_key()
{
    return added_key(make_key("method.content", "what is stored", "", only(Stage::prefilter)),
                     WordDomain{.words = {"half", "full"}}, std::string{"full"}, {}, {"vsm"});
}
Key offset_key()
{
    return added_key(make_key("bias.offset", "how far", "", only(Stage::lookup), "m"),
                     RealDomain{.lower = -1, .upper = 1}, 0.5, {}, {"moments"});
}
Key blur_key()
{
    return added_key(make_key("method.blur", "how much", "", only(Stage::lookup)),
                     RealDomain{.lower = 0, .upper = 1}, 0.25, {}, {"moments"});
}

std::vector<MethodChoice> made_up_methods()
{
    return {{"depth", true},
            {"vsm", false},
            {"moments", true},
            {"volumes", false, {"shadow_map", "lookup", "bias"}}};
}

/// The message of the std::logic_error that a table of those keys throws, or "no error".
std::string logic_error_of(std::vector<Key> keys,
                           std::vector<MethodChoice> methods = made_up_methods())
{
    try {
        const KeyTable table{std::move(methods), std::move(keys)};
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "no error";
}

Keys made_up_keys()
{
    return std::make_shared<const KeyTable>(
        made_up_methods(), std::vector{width_key(), offset_key(), content_key(), blur_key()});
}

JobFile made_up_job(const std::string& text, const std::vector<Override>& overrides = {},
                    std::string_view case_name = {})
{
    return job_of(text, overrides, case_name, made_up_keys());
}

std::string made_up_refusal(const std::string& text, const std::vector<Override>& overrides = {})
{
    return refusal(text, overrides, {}, made_up_keys());
}

const std::string wall = "scene.builtin = \"wall\"\n";

std::string wall_with(const std::string& method, const std::string& keys = "")
{
    return wall + "[method]\nname = \"" + method + "\"\n" + keys;
}

/// The job's keys of `[method]`, as "name = value".
std::vector<std::string> method_keys(const Job& job)
{
    std::vector<std::string> keys;
    for (const auto& [key, value] : resolved_keys(job)) {
        if (key.starts_with("method.")) {
            keys.push_back(key + " = " + value);
        }
    }
    return keys;
}

TEST(KeyTable, RefusesKeysThatRepeat)
{
    EXPECT_EQ(logic_error_of({width_key(), blur_key(), width_key()}),
              "KeyTable: method.width repeats");
    EXPECT_EQ(logic_error_of({width_key(), blur_key()}), "no error");
}

TEST(KeyTable, RefusesKeysOfTheScenesOwnTables)
{
    EXPECT_EQ(logic_error_of({added_key(make_key("lookup.width", "", "", only(Stage::lookup)),
                                        IntegerDomain{1, 9}, std::int64_t{5})}),
              "KeyTable: lookup.width is not of [method], [bias] or [engine]");
}

TEST(KeyTable, RefusesAddedKeysOfTheNameOfAnOwnOne)
{
    const Key constant = added_key(make_key("bias.constant", "", "", only(Stage::lookup)),
                                   RealDomain{.lower = 0, .upper = 1}, 0.0);
    EXPECT_EQ(logic_error_of({constant}), "KeyTable: bias.constant repeats");
}

TEST(KeyTable, RefusesKeysWithoutADefault)
{
    EXPECT_EQ(logic_error_of({make_key("method.bare", "", "", only(Stage::lookup))}),
              "KeyTable: method.bare has no default");
}

TEST(KeyTable, RefusesToBeWithoutMethods)
{
    EXPECT_EQ(logic_error_of({}, {}), "KeyTable: there is no method");
}

TEST(KeyTable, StandsBesideOthersInOneProcess)
{
    const std::string text = wall_with("vsm", "width = 3\n");
    const Keys first = made_up_keys();
    const Keys second =
        std::make_shared<const KeyTable>(made_up_methods(), std::vector{blur_key()});
    const Job job = job_of(text, {}, {}, first).job;
    EXPECT_THAT(refusal(text, {}, {}, second), HasSubstr("unknown key \"method.width\""));
    EXPECT_THAT(refusal(text), HasSubstr("method.name = \"vsm\": must be one of depth"));
    const Job other = job_of(wall_with("moments"), {}, {}, second).job;
    EXPECT_THAT(method_keys(job), ElementsAre("method.name = \"vsm\"", "method.width = 3",
                                              "method.content = \"full\""));
    EXPECT_THAT(method_keys(other), ElementsAre("method.name = \"moments\"", "method.blur = 0.25"));
    EXPECT_EQ(&keys_of(job), first.get());
    EXPECT_EQ(&keys_of(other), second.get());
    EXPECT_EQ(&keys_of(Job{}), own_keys().get());
}

TEST(KeyTable, TakesTheKeysOfAnotherRenderer)
{
    const Key softness =
        scene::added_key(make_key("engine.softness", "how soft", "", only(Stage::lookup)),
                         RealDomain{.lower = 0, .upper = 1}, 0.5, {});
    const Keys own = made_up_keys();
    const Keys with_engine = own->with_engine_keys({softness});
    const std::string text = wall + "engine.softness = 0.25\n";
    EXPECT_THAT(refusal(text, {}, {}, own), HasSubstr("keys of [engine] are a renderer's"));
    const Job job = job_of(text, {}, {}, with_engine).job;
    ASSERT_NE(find_added_value(job, "engine.softness"), nullptr);
    EXPECT_EQ(*find_added_value(job, "engine.softness"), JobValue{0.25});
    EXPECT_EQ(with_engine->rows().back().name, "engine.softness");
    EXPECT_EQ(own->rows().size() + 1, with_engine->rows().size());
}

TEST(Key, StandsInTheTableBehindTheMethodsName)
{
    const Keys table = made_up_keys();
    std::vector<std::string> names;
    for (const Key& key : table->rows()) {
        if (key.name.starts_with("method.")) {
            names.push_back(key.name);
        }
    }
    EXPECT_THAT(names, ElementsAre("method.name", "method.width", "method.content", "method.blur"));
    EXPECT_EQ(table->find("method.name")->range_text, "one of depth, vsm, moments, volumes");
    const Key& width = *table->find("method.width");
    EXPECT_EQ(width.default_text, "5");
    EXPECT_EQ(width.range_text, "an odd integer from 1 to 9");
    EXPECT_EQ(width.stages, only(Stage::prefilter));
    EXPECT_EQ(width.unit, "texels");
    EXPECT_EQ(table->find("method.content")->default_text, "\"full\"");
    EXPECT_EQ(table->find("method.blur")->default_text, "0.25");
}

TEST(Key, OfABiasStandsBehindTheScenesOwnBiases)
{
    const Keys table = made_up_keys();
    const auto& rows = table->rows();
    ASSERT_GE(rows.size(), 2U);
    EXPECT_EQ(rows.back().name, "bias.offset");
    EXPECT_EQ(rows[rows.size() - 2].name, "bias.normal_texels");
}

TEST(Key, OfABiasIsResolvedToFloat32ForJobsOfItsMethod)
{
    const auto bias_of = [](const std::string& text) {
        const Job job = made_up_job(text).job;
        const SceneFile file = load_scene(job.scene);
        return resolve_view(job, file.scene, file.defaults).bias;
    };
    EXPECT_EQ(bias_of(wall_with("moments", "[bias]\noffset = 0.1\n")).find_added("bias.offset"),
              0.1F);
    EXPECT_EQ(bias_of(wall_with("moments")).find_added("bias.offset"), 0.5F);
    EXPECT_FALSE(bias_of(wall_with("moments")).find_added("method.blur"));
    EXPECT_TRUE(bias_of(wall_with("vsm")).added.empty());
}

TEST(Key, IsFoundByItsName)
{
    const Keys table = made_up_keys();
    EXPECT_EQ(table->find("method.width")->name, "method.width");
    EXPECT_TRUE(table->find("method.width")->is_added());
    EXPECT_FALSE(table->find("method.name")->is_added()) << "is the scene's own";
    EXPECT_EQ(table->find("width"), nullptr);
    EXPECT_EQ(table->find(""), nullptr);
}

TEST(Key, IsOfTheMethodsThatHaveIt)
{
    EXPECT_TRUE(width_key().is_of("vsm"));
    EXPECT_TRUE(width_key().is_of("moments"));
    EXPECT_FALSE(width_key().is_of("depth"));
    EXPECT_FALSE(content_key().is_of("moments"));
    EXPECT_FALSE(content_key().is_of(""));
}

TEST(Key, HasItsDefaultUntilAJobSetsIt)
{
    EXPECT_EQ(width_key().value_of(Job{}.method), JobValue{std::int64_t{5}});
    const Job job = made_up_job(wall_with("vsm", "width = 9\n")).job;
    EXPECT_EQ(job.method.name, "vsm");
    EXPECT_EQ(width_key().value_of(job.method), JobValue{std::int64_t{9}});
    EXPECT_EQ(content_key().value_of(job.method), JobValue{std::string{"full"}});
    EXPECT_EQ(job.method.values.size(), 1U);
}

TEST(Key, IsAmongTheKeysOfJobsOfItsMethodAlone)
{
    EXPECT_THAT(method_keys(made_up_job(wall).job), ElementsAre("method.name = \"depth\""));
    EXPECT_THAT(
        method_keys(made_up_job(wall_with("vsm", "width = 3\n")).job),
        ElementsAre("method.name = \"vsm\"", "method.width = 3", "method.content = \"full\""));
    EXPECT_THAT(method_keys(made_up_job(wall_with("moments")).job),
                ElementsAre("method.name = \"moments\"", "method.width = 5", "method.blur = 0.25"));
}

TEST(Key, ReadsBackAsItWasWritten)
{
    const auto keys = resolved_keys(made_up_job(wall_with("vsm", "content = \"half\"\n")).job);
    std::string text;
    for (const auto& [key, value] : keys) {
        text += key + " = " + value + "\n";
    }
    EXPECT_EQ(resolved_keys(made_up_job(text).job), keys) << text;
}

TEST(Key, IsRefusedOutsideItsRange)
{
    EXPECT_EQ(made_up_refusal(wall_with("vsm", "width = 4\n")),
              "job.toml:4: method.width = 4: must be an odd integer from 1 to 9");
    EXPECT_EQ(made_up_refusal(wall_with("vsm", "content = \"hull\"\n")),
              "job.toml:4: method.content = \"hull\": must be one of half, full; the nearest is "
              "\"full\"");
}

TEST(Key, IsRefusedOfAnotherMethodByOneLineThatNamesBoth)
{
    EXPECT_EQ(made_up_refusal(wall + "method.content = \"half\"\n"),
              "job.toml:2: method.content = \"half\": is for method.name = \"vsm\", and the job's "
              "method is \"depth\"; remove it, or set that");
    EXPECT_EQ(made_up_refusal(wall_with("moments", "content = \"half\"\n")),
              "job.toml:4: method.content = \"half\": is for method.name = \"vsm\", and the job's "
              "method is \"moments\"; remove it, or set that");
    EXPECT_EQ(made_up_refusal(wall, {{"method.width", "3"}}),
              "--set method.width=3: is for method.name = \"vsm\" or \"moments\", and the job's "
              "method is \"depth\"; remove it, or set that");
    EXPECT_EQ(made_up_refusal(wall, {{"method.width", "3"}, {"method.name", "vsm"}}), "no error");
}

TEST(MethodName, NamesTheNearestOfTheTable)
{
    EXPECT_EQ(made_up_job(wall).job.method.name, "depth");
    EXPECT_EQ(made_up_job(wall_with("moments")).job.method.name, "moments");
    EXPECT_EQ(made_up_refusal(wall_with("vms")),
              "job.toml:3: method.name = \"vms\": must be one of depth, "
              "vsm, moments, volumes; the nearest is \"vsm\"");
    EXPECT_THAT(made_up_refusal(wall, {{"method.name", "esm"}}),
                HasSubstr("the nearest is \"vsm\""));
    EXPECT_THAT(made_up_refusal(wall + "method.wdth = 3\n"),
                HasSubstr("unknown key \"method.wdth\"; the nearest is method.width"));
}

TEST(MethodName, LeavesTheKeysOfAnotherMethodBehindInTheLayersBelow)
{
    const std::string text = wall_with("vsm", "width = 3\ncontent = \"half\"\n");
    EXPECT_THAT(method_keys(made_up_job(text, {{"method.name", "moments"}}).job),
                ElementsAre("method.name = \"moments\"", "method.width = 3", "method.blur = 0.25"));
    EXPECT_THAT(method_keys(made_up_job(text, {{"method.name", "depth"}}).job),
                ElementsAre("method.name = \"depth\""));
    EXPECT_THAT(
        method_keys(made_up_job(text, {{"method.name", "vsm"}}).job),
        ElementsAre("method.name = \"vsm\"", "method.width = 3", "method.content = \"half\""));
    // Settings in the method's own layer are not dropped.
    EXPECT_THAT(made_up_refusal(text, {{"method.name", "moments"}, {"method.content", "half"}}),
                HasSubstr("--set method.content=half: is for method.name = \"vsm\""));
}

TEST(MethodName, DecidesWhetherAJobHasAFilter)
{
    const Keys table = made_up_keys();
    EXPECT_TRUE(table->has_filters("depth"));
    EXPECT_TRUE(table->has_filters("moments"));
    EXPECT_FALSE(table->has_filters("vsm"));
    EXPECT_FALSE(table->has_filters("esm")) << "is no method";
    EXPECT_EQ(texts_by_key(made_up_job(wall_with("moments")).job).count("lookup.filter"), 1U);
    EXPECT_EQ(texts_by_key(made_up_job(wall_with("vsm")).job).count("lookup.filter"), 0U);
    EXPECT_EQ(made_up_refusal(wall_with("vsm", "[lookup]\nfilter = \"pcf3\"\n")),
              "job.toml:5: lookup.filter = \"pcf3\": the method vsm has no filter; remove it");
}

TEST(MethodName, DecidesWhichSharedTablesAJobHas)
{
    const auto keys = texts_by_key(made_up_job(wall_with("volumes")).job);
    for (const char* const table : {"shadow_map.", "lookup.", "bias."}) {
        const auto first = keys.lower_bound(table);
        EXPECT_FALSE(first != keys.end() && first->first.starts_with(table)) << table;
    }
    EXPECT_EQ(keys.count("light.type"), 1U);
    EXPECT_EQ(
        made_up_refusal(wall_with("volumes", "[bias]\nconstant = 0.001\n")),
        "job.toml:5: bias.constant = 0.001: the method volumes reads no [bias]; remove all of "
        "that table's keys");
    EXPECT_THAT(
        made_up_refusal(wall, {{"method.name", "volumes"}, {"shadow_map.resolution", "64"}}),
        HasSubstr("--set shadow_map.resolution=64: the method volumes reads no "
                  "[shadow_map]; remove all of that table's keys"));
}

TEST(MethodName, LeavesTheTablesThatItLacksBehindInTheLayersBelow)
{
    const std::string text = wall + "[bias]\nconstant = 0.5\n[shadow_map]\nresolution = 64\n";
    const Job job = made_up_job(text, {{"method.name", "volumes"}}).job;
    EXPECT_EQ(job.bias.constant, 0);
    EXPECT_EQ(job.shadow_map.resolution_texels, Job{}.shadow_map.resolution_texels);
    EXPECT_EQ(made_up_job(text, {{"method.name", "vsm"}}).job.bias.constant, 0.5);
    // A method in between drops no key that the last method has.
    const std::string between = wall + "[bias]\nconstant = 0.5\n[[case]]\nname = \"a\"\n"
                                       "method.name = \"volumes\"\n";
    EXPECT_EQ(made_up_job(between, {{"method.name", "vsm"}}, "a").job.bias.constant, 0.5);
    EXPECT_EQ(made_up_job(between, {}, "a").job.bias.constant, 0);
}

TEST(MethodName, OfOneLightLeavesBehindWhatIsSaidOfAll)
{
    const std::string text = wall + "[bias]\nconstant = 0.5\n[shadow_map]\nresolution = 64\n"
                                    "[[lights]]\nname = \"key\"\ntype = \"directional\"\n"
                                    "[[lights]]\nname = \"fill\"\ntype = \"directional\"\n"
                                    "method.name = \"volumes\"\n";
    const auto lights = light_jobs(read_job_source(write_job(text), {}, {}, made_up_keys()));
    ASSERT_EQ(lights.size(), 2U);
    EXPECT_EQ(lights[0].job.bias.constant, 0.5);
    EXPECT_EQ(lights[0].job.shadow_map.resolution_texels, 64);
    EXPECT_EQ(lights[1].job.method.name, "volumes");
    EXPECT_EQ(lights[1].job.bias.constant, 0);
    // Settings for that light itself are not dropped.
    const std::string refused = text + "bias.slope = 0.1\n";
    EXPECT_THAT(error_of([&] {
                    return light_jobs(read_job_source(write_job(refused), {}, {}, made_up_keys()));
                }),
                HasSubstr("reads no [bias]"));
}

TEST(MethodName, WithoutFiltersLeavesThatOfTheLayersBelowBehind)
{
    const std::string text = wall + "lookup = {filter = \"pcf3\", outside = \"clamp\"}\n";
    const auto keys = texts_by_key(made_up_job(text, {{"method.name", "vsm"}}).job);
    EXPECT_EQ(keys.count("lookup.filter"), 0U);
    EXPECT_EQ(keys.at("lookup.outside"), "\"clamp\"");
    EXPECT_EQ(texts_by_key(made_up_job(text, {{"method.name", "moments"}}).job).at("lookup.filter"),
              "\"pcf3\"");
    EXPECT_EQ(made_up_refusal(text, {{"method.name", "vsm"}, {"lookup.filter", "pcf5"}}),
              "--set lookup.filter=pcf5: the method vsm has no filter; remove it");
}

TEST(MethodName, OfACaseReplacesThatOfTheFile)
{
    const std::string text = wall_with("vsm", "content = \"half\"\n") +
                             "[[case]]\nname = \"plain\"\nmethod.name = \"depth\"\n";
    EXPECT_THAT(method_keys(made_up_job(text, {}, "plain").job),
                ElementsAre("method.name = \"depth\""));
    EXPECT_EQ(made_up_job(text).job.method.name, "vsm");
}

TEST(CommentedJobFile, HasTheKeysOfAllMethods)
{
    const std::string text = commented_job_file({}, made_up_keys());
    EXPECT_THAT(text, AllOf(HasSubstr("name = \"depth\""), HasSubstr("width = 5"),
                            HasSubstr("content = \"full\""), HasSubstr("blur = 0.25")));
    EXPECT_EQ(made_up_refusal(text), "no error");
}

TEST(IntegerDomain, TakesEveryIntegerByItself)
{
    const Domain domain = IntegerDomain{1, 3};
    EXPECT_EQ(range_text(domain), "an integer from 1 to 3");
    for (const std::int64_t integer : {1, 2, 3}) {
        EXPECT_EQ(read_value(domain, {integer}), JobValue{integer});
    }
}

TEST(IntegerDomain, TakesOddNumbersAloneInStepsOfTwo)
{
    const Domain domain = IntegerDomain{1, 9, 2};
    EXPECT_EQ(range_text(domain), "an odd integer from 1 to 9");
    for (const std::int64_t odd : {1, 3, 5, 7, 9}) {
        EXPECT_EQ(read_value(domain, {odd}), JobValue{odd});
    }
    for (const std::int64_t refused : {-1, 0, 2, 4, 8, 10, 11}) {
        EXPECT_FALSE(read_value(domain, {refused})) << refused;
    }
    EXPECT_FALSE(read_value(domain, {3.0}));
    EXPECT_EQ(refusal_text(domain, {std::int64_t{4}}), "must be an odd integer from 1 to 9");
}

} // namespace
} // namespace gnomon::scene::test
