// Every key of the job file, one by one: its limits, its refusals, its text.

#include "job_fixture.hpp"

#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/keys/keys.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace gnomon::scene::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Values that a key accepts and refuses, in TOML; `context` has other keys that it needs.
struct KeyCases {
    std::vector<std::string> accepted; ///< as `resolved_keys` prints them
    std::vector<std::string> refused;
    std::vector<Override> context;
};

const std::vector<Override> spot{{"light.type", "spot"},
                                 {"light.position", "[1, 2, 3]"},
                                 {"light.target", "[0, 0, 0]"},
                                 {"bias.constant", "0"}};

const std::vector<Override> noon{{"light.sun.latitude_deg", "52.5"},
                                 {"light.sun.longitude_deg", "13.4"},
                                 {"light.sun.time", "\"2026-06-21T12:00:00Z\""}};

const std::vector<Override> cascades{{"shadow_map.layout", "cascades"}};

std::vector<Override> with(std::vector<Override> first, const std::vector<Override>& more)
{
    first.insert(first.end(), more.begin(), more.end());
    return first;
}

const KeyCases vectors{{"[1, 2, 3]", "[-1e+15, 1e+15, 0.1]", "[0, 0, 0]"},
                       {"[1, 2]", "[1, 2, 3, 4]", "[1, 2, \"3\"]", "[1, 2, nan]", "[1, -inf, 3]",
                        "[1, 2, 1.01e15]", "7", "\"up\""},
                       {}};
const KeyCases directions{{"[1, 2, 3]", "[0, -1e-30, 0]"},
                          // The last is zero once it is a float32.
                          {"[0, 0, 0]", "[1, 2]", "[1e-60, 0, 0]"},
                          {}};
const KeyCases sides{{"1", "4097", "16384"},
                     {"0", "-1", "16385", "20000", "1000000000", "640.0", "\"abc\"", "true"},
                     {}};
const KeyCases flags{{"true", "false"}, {"1", "\"yes\"", "[]"}, {}};
const KeyCases angles{{"0.001", "45", "179.999"}, {"0", "-5", "0.0009", "180", "\"wide\""}, {}};
const KeyCases names{
    {"[]", "[\"wall\"]", "[\"a b\", \"c\\\"d\"]"}, {"\"wall\"", "[1]", "[\"\"]"}, {}};
const KeyCases planes{{"\"auto\"", "-1e+15", "0", "0.5"}, {"\"Auto\"", "1.1e15", "true"}, {}};

KeyCases biases(const std::string& largest, const std::string& beyond)
{
    // 1.1754943508222875e-38 is the smallest normal float32; the double below it rounds to a
    // subnormal and 1e-60 to zero. Both are refused, because GL would receive another value.
    return {{"0", "0.25", "-0.25", "1.1754943508222875e-38", largest, "-" + largest},
            {"1.175e-38", "-1e-45", "1e-60", beyond, "-" + beyond, "\"small\"", "[0]"},
            {}};
}

KeyCases beside(KeyCases cases, const std::vector<Override>& context)
{
    cases.context = context;
    return cases;
}

const std::vector<Override> of_file{{"scene.file", "a.obj"}};

const std::map<std::string, KeyCases> key_cases{
    {"scene.builtin", {{"\"wall\"", "\"room\""}, {"\"walls\"", "3", "\"\""}, {}}},
    {"scene.file", {{"\"a.obj\"", "\"/b c/d.glb\""}, {"\"\"", "7", "\"a\\u0000b\""}, {}}},
    {"scene.lights", {{}, {"\"some\"", "1", "true"}, {}}}, // no job of one light prints it
    {"scene.unit_m",
     beside({{"1e-09", "0.01", "1e+09"}, {"0", "-1", "2e9", "\"mm\""}, {}}, of_file)},
    {"scene.up", beside({{"\"z\""}, {"\"x\"", "\"Z\"", "2"}, {}}, of_file)}, // y prints nothing
    {"scene.ground", flags},
    {"scene.no_cast", names},
    {"scene.no_receive", names},
    {"scene.north", {{"[1, 2, 3]", "[0, 0, -1]"}, {"[0, 0, 0]", "[1, 2]"}, {}}},
    {"camera.eye", vectors},
    {"camera.target", vectors},
    {"camera.up", directions},
    {"camera.vertical_fov_deg", angles},
    {"camera.orthographic_height", {{"1e-06", "4", "1e+15"}, {"0", "-4", "9e-7", "2e15"}, {}}},
    {"image.width", beside(sides, {{"image.height", "2"}})},
    {"image.height", beside(sides, {{"image.width", "2"}})},
    {"light.type", {{"\"directional\""}, {"\"sun\"", "1"}, {}}},
    {"light.direction", directions},
    {"light.position", beside(vectors, spot)},
    {"light.target", beside(vectors, spot)},
    {"light.cone_deg", beside(angles, spot)},
    {"light.sun.latitude_deg", {{"-60", "52.5", "90"}, {"90.1", "-91", "\"north\""}, noon}},
    {"light.sun.longitude_deg", {{"-90", "13.4", "100"}, {"180.1", "-181", "\"east\""}, noon}},
    {"light.sun.time",
     {{"\"2010-01-01T12:00:00Z\"", "\"2109-12-31T12:59:59.9Z\"", "\"2026-06-21T14:00+02:00\""},
      {"\"2009-12-31T12:00:00Z\"", "\"2110-01-01T12:00Z\"", "\"2026-06-21T14:00\"", "\"noon\"",
       "12"},
      noon}},
    {"method.name", {{"\"depth\""}, {"\"depths\"", "\"\"", "1"}, {}}},
    {"shadow_map.resolution", sides},
    {"shadow_map.depth_format",
     {{"\"d16\"", "\"d24\"", "\"d32\"", "\"d32f\"", "\"u8\"", "\"u13\"", "\"u24\""},
      {"\"u7\"", "\"u25\"", "\"u08\"", "\"d25\"", "\"D24\"", "24"},
      {}}},
    {"shadow_map.layout",
     {{"\"cube\""}, {"\"ring\"", "6"}, {{"light.type", "point"}, {"light.position", "[0, 3, 1]"}}}},
    {"shadow_map.cascades", beside({{"2", "4", "8"}, {"1", "9", "4.5", "\"two\""}, {}}, cascades)},
    {"shadow_map.split",
     beside({{"\"uniform\"", "\"logarithmic\"", "\"practical\""}, {"\"even\"", "1"}, {}},
            cascades)},
    {"shadow_map.split_lambda", beside({{"0", "0.5", "1"}, {"-0.1", "2", "\"a\""}, {}}, cascades)},
    {"shadow_map.cascade_near",
     beside({{"\"auto\"", "1e-06", "0.5"}, {"0", "-1", "\"Auto\"", "2e15"}, {}}, cascades)},
    {"shadow_map.cascade_far",
     beside({{"\"auto\"", "1e-06", "1e+15"}, {"0", "-1", "\"Auto\"", "2e15"}, {}}, cascades)},
    {"shadow_map.cascade_fit",
     beside({{"\"tight\"", "\"stabilised\""}, {"\"stable\"", "1"}, {}},
            with(cascades, {{"shadow_map.cascade_near", "1"}, {"shadow_map.cascade_far", "9"}}))},
    {"shadow_map.select",
     beside({{"\"view_depth\"", "\"containing\""}, {"\"nearest\"", "1"}, {}}, cascades)},
    {"shadow_map.blend", beside({{"0", "0.1", "0.999"}, {"1", "-0.1", "\"a\""}, {}}, cascades)},
    {"shadow_map.content", {{"\"distance\"", "\"linear\""}, {"\"depths\"", "1"}, spot}},
    {"shadow_map.fit", {{"\"scene\"", "\"camera\"", "\"fixed\""}, {"\"tight\"", "0"}, {}}},
    {"shadow_map.half_extent",
     {{"1e-06", "20", "1e+15"}, {"0", "-1", "2e15"}, {{"shadow_map.fit", "fixed"}}}},
    {"shadow_map.fov_deg", beside(angles, with(spot, {{"shadow_map.fit", "fixed"}}))},
    {"shadow_map.roll_deg", {{"-360", "0.5", "360"}, {"361", "-360.01", "\"left\""}, {}}},
    {"shadow_map.near", beside(planes, {{"shadow_map.far", "auto"}})},
    {"shadow_map.far", beside(planes, {{"shadow_map.near", "auto"}})},
    {"shadow_map.cull", {{"\"none\"", "\"front\"", "\"back\""}, {"\"both\"", "false"}, {}}},
    {"shadow_map.reversed", flags},
    {"lookup.filter",
     {{"\"nearest\"", "\"linear\"", "\"hardware\"", "\"pcf3\"", "\"pcf5\"", "\"pcf7\"", "\"pcf9\"",
       "\"bilinear3\"", "\"bilinear5\"", "\"bilinear7\""},
      {"\"pcf4\"", "\"pcf11\"", "3"},
      {}}},
    {"lookup.outside", {{"\"lit\"", "\"shadowed\"", "\"clamp\""}, {"\"border\"", "1"}, {}}},
    {"lookup.position", {{"\"vertex\"", "\"pixel\""}, {"\"texel\"", "0"}, {}}},
    {"bias.constant", biases("1", "1.0000001")},
    {"bias.constant_m", biases("1e+15", "1.1e15")},
    {"bias.slope", biases("1000", "1000.1")},
    {"bias.normal_texels", biases("1000", "1000.1")}};

bool is_parameter(const std::string& key)
{
    return key.starts_with("scene.") && std::count(key.begin(), key.end(), '.') == 2;
}

TEST(JobKeys, AreAllCoveredByTheCasesBelow)
{
    for (const Key& key : own_keys()->rows()) {
        EXPECT_TRUE(is_parameter(key.name) || key_cases.contains(key.name)) << key.name;
    }
}

TEST(JobKeys, AcceptTheirRangesAndPrintWhatTheyAccepted)
{
    for (const auto& [key, cases] : key_cases) {
        for (const std::string& value : cases.accepted) {
            SCOPED_TRACE(key + " = " + value);
            const Job job = builtin_job("wall", with(cases.context, {{key, value}})).job;
            EXPECT_EQ(texts_by_key(job)[key], value);
        }
    }
}

TEST(JobKeys, RefuseWhatIsOutsideNamingKeyValueAndRange)
{
    for (const auto& [key, cases] : key_cases) {
        for (const std::string& value : [&] { // no key takes these
                 std::vector<std::string> all = cases.refused;
                 all.insert(all.end(), {"nan", "inf", "-inf", "1979-05-27", "[[1]]", "{a = 1}"});
                 return all;
             }()) {
            const std::string message = error_of([&] {
                return builtin_job("wall", with(cases.context, {{key, value}}));
            });
            EXPECT_THAT(message, HasSubstr(fmt::format("--set {}={}: ", key, value)));
            EXPECT_THAT(message, HasSubstr("must be " + own_keys()->find(key)->range_text));
        }
    }
}

TEST(JobKeys, OfBuiltInParametersAcceptTheirLimitsAndNothingBeyond)
{
    for (const BuiltinScene& scene : builtin_scenes()) {
        for (const BuiltinParameter& parameter : scene.parameters) {
            const std::string key = parameter_prefix(scene.name) + parameter.name;
            SCOPED_TRACE(key);
            const auto message = [&](const std::string& value) {
                return error_of([&] { return builtin_job(scene.name, {{key, value}}); });
            };
            EXPECT_THAT(message("nan"), HasSubstr("must be " + own_keys()->find(key)->range_text));
            for (const std::string& word : parameter.words) {
                EXPECT_EQ(message(word), "no error");
            }
            if (!parameter.words.empty()) {
                EXPECT_THAT(message(parameter.words[0] + "x"), HasSubstr("the nearest is"));
                continue;
            }
            const auto text = [&](double number) {
                return parameter.is_integer ? fmt::format("{:.0f}", number) : toml_number(number);
            };
            const double infinity = std::numeric_limits<double>::infinity();
            for (const auto& [limit, outward] :
                 {std::pair{parameter.lower, -infinity}, std::pair{parameter.upper, infinity}}) {
                const double beyond = parameter.is_integer ? limit + std::copysign(1, outward)
                                                           : std::nextafter(limit, outward);
                EXPECT_EQ(message(text(limit)), "no error") << limit;
                EXPECT_THAT(message(text(beyond)), HasSubstr("must be")) << beyond;
            }
        }
    }
}

TEST(JobKeys, DefaultTextsAndExamplesAreWithinTheirRanges)
{
    for (const Key& spec : own_keys()->rows()) {
        const std::string& shown = spec.default_text.empty() ? spec.example : spec.default_text;
        const auto node = parse_toml_value(shown);
        ASSERT_TRUE(node) << spec.name << " = " << shown;
        EXPECT_TRUE(read_value(spec.domain, *node)) << spec.name << " = " << shown;
    }
}

TEST(JobKeys, DefaultTextsAreTheDefaultsOfAJob)
{
    Job job;
    job.camera.emplace();
    job.light.emplace().direction = Vec3d{-0.4, -1, -0.3};
    const auto keys = texts_by_key(job);
    for (const Key& key : own_keys()->rows()) {
        const auto value = keys.find(key.name);
        if (value != keys.end()) {
            EXPECT_EQ(value->second, key.default_text) << key.name;
        }
    }
}

TEST(JobKeys, HaveAUniqueNameADescriptionARangeAndAStage)
{
    std::set<std::string> seen;
    for (const Key& key : own_keys()->rows()) {
        EXPECT_TRUE(seen.insert(key.name).second) << key.name;
        EXPECT_FALSE(key.description.empty()) << key.name;
        EXPECT_FALSE(key.range_text.empty()) << key.name;
        EXPECT_NE(key.stages, 0) << key.name;
    }
}

TEST(JobKeys, NameTheStagesThatTheyChange)
{
    const auto stages = [](std::string_view key) { return own_keys()->find(key)->stages; };
    EXPECT_EQ(stages("bias.constant"), only(Stage::bias));
    EXPECT_EQ(stages("bias.slope"), only(Stage::bias));
    EXPECT_EQ(stages("bias.normal_texels"), only(Stage::lookup));
    EXPECT_EQ(stages("lookup.filter"), only(Stage::lookup));
    EXPECT_EQ(stages("method.name"), Stage::prefilter | Stage::lookup);
    EXPECT_EQ(stages("shadow_map.depth_format"), only(Stage::shadow_map));
    EXPECT_EQ(stages("shadow_map.roll_deg"), Stage::receivers | Stage::shadow_map);
    EXPECT_EQ(stages("camera.eye"), Stage::truth | Stage::receivers | Stage::shadow_map);
    EXPECT_EQ(stages("light.direction"), Stage::truth | Stage::receivers | Stage::shadow_map);
    EXPECT_EQ(stages("scene.wall.thickness_m"), only(Stage::scene));
    for (const Key& key : own_keys()->rows()) {
        const bool changes_truth = key.name.starts_with("camera.") ||
                                   key.name.starts_with("image.") ||
                                   key.name.starts_with("light.") || key.name == "scene.north";
        EXPECT_EQ((key.stages & only(Stage::truth)) != 0, changes_truth) << key.name;
    }
}

TEST(JobKeys, HaveTheUnitThatTheirDescriptionNames)
{
    const auto key = [](std::string_view name) { return *own_keys()->find(name); };
    EXPECT_EQ(key("camera.eye").unit, "m");
    EXPECT_EQ(key("image.width").unit, "px");
    EXPECT_EQ(key("shadow_map.resolution").unit, "texels");
    EXPECT_EQ(key("bias.constant").unit, "depth units");
    EXPECT_EQ(key("bias.constant").description,
              "constant bias, depth units; or constant_m instead");
    EXPECT_EQ(key("bias.normal_texels").unit, "texel widths");
    EXPECT_EQ(key("scene.wall.thickness_m").unit, "m");
    EXPECT_EQ(key("lookup.filter").unit, "");
    for (const Key& each : own_keys()->rows()) {
        EXPECT_THAT(each.description, HasSubstr(each.unit)) << each.name;
        EXPECT_THAT(each.description, Not(HasSubstr("{unit}"))) << each.name;
        for (const std::string unit : {"m", "deg", "px"}) {
            const bool is_named = each.description.find("[" + unit + "]") != std::string::npos;
            EXPECT_EQ(is_named, each.unit == unit) << each.name;
        }
    }
}

TEST(JobKeys, SpellTheirStages)
{
    EXPECT_TRUE(stage_names(0).empty());
    EXPECT_EQ(stage_names(only(Stage::scene)), std::vector<std::string_view>{"scene"});
    EXPECT_EQ(stage_names(0x7F),
              (std::vector<std::string_view>{"scene", "truth", "receivers", "shadow_map",
                                             "prefilter", "lookup", "bias"}));
}

RC_GTEST_PROP(JobKeys, PrintNumbersThatReadBackAsTheSameBits, ())
{
    const auto number = *rc::gen::arbitrary<double>();
    RC_PRE(std::isfinite(number));
    const auto node = parse_toml_value(toml_number(number));
    RC_ASSERT(node.has_value());
    const auto* integer = std::get_if<std::int64_t>(&node->value);
    const double back =
        integer != nullptr ? static_cast<double>(*integer) : std::get<double>(node->value);
    RC_ASSERT(back == number);
    RC_ASSERT(std::signbit(back) == std::signbit(number));
}

RC_GTEST_PROP(JobKeys, QuoteTextsThatReadBackAsTheSameBytes, ())
{
    const auto text = *rc::gen::container<std::string>(rc::gen::inRange<char>(1, 127));
    const auto node = parse_toml_value(toml_quoted(text));
    RC_ASSERT(node.has_value());
    RC_ASSERT(std::get<std::string>(node->value) == text);
}

TEST(DepthFormat, NamesAndFormatsAreInverse)
{
    for (const std::string name :
         {"d16", "d24", "d32", "d32f", "r32f", "r16f", "rgba8", "u8", "u16", "u24"}) {
        const auto format = depth_format_from_name(name);
        ASSERT_TRUE(format) << name;
        EXPECT_EQ(depth_format_name(*format), name);
    }
    EXPECT_EQ(depth_format_from_name("d32f")->bits, 32);
    EXPECT_EQ(depth_format_from_name("u13")->bits, 13);
    EXPECT_TRUE(depth_format_from_name("d32f")->is_float());
    EXPECT_TRUE(depth_format_from_name("r32f")->is_float());
    EXPECT_TRUE(depth_format_from_name("r16f")->is_float());
    EXPECT_FALSE(depth_format_from_name("d32")->is_float());
    EXPECT_FALSE(depth_format_from_name("rgba8")->is_float());
    for (const std::string name : {"", "u", "u7", "u25", "u013", "d8", "d24 ", "r8", "rgba16"}) {
        EXPECT_FALSE(depth_format_from_name(name)) << name;
    }
}

TEST(Filter, HasANameForEachEnumeratorAndNoMore)
{
    EXPECT_EQ(filter_count, 10U);
    EXPECT_EQ(filter_name(Filter::nearest), "nearest");
    EXPECT_EQ(filter_name(Filter::pcf9), "pcf9");
    EXPECT_EQ(filter_name(Filter::bilinear7), "bilinear7");
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i < filter_count; ++i) {
        EXPECT_TRUE(seen.insert(filter_name(static_cast<Filter>(i))).second) << i;
    }
    EXPECT_EQ(filter_name(static_cast<Filter>(filter_count)), "");
}

TEST(NearestWord, NeedsTheFewestEdits)
{
    const std::vector<std::string> words{"nearest", "linear", "hardware", "pcf3"};
    EXPECT_EQ(nearest_word("linear", words), "linear");
    EXPECT_EQ(nearest_word("liner", words), "linear");
    EXPECT_EQ(nearest_word("pcf", words), "pcf3");
    EXPECT_EQ(nearest_word("neerst", words), "nearest");
    EXPECT_EQ(nearest_word("", words), "pcf3");    // four insertions: the shortest word
    EXPECT_EQ(nearest_word("x", {"a", "b"}), "a"); // equally near: the first
    EXPECT_EQ(nearest_word("x", {}), "");
}

TEST(SimilarWord, IsTheNearestThatSomebodyMayHaveMeant)
{
    const std::vector<std::string> words{"compare", "tune", "gate"};
    EXPECT_EQ(similar_word("comprae", words), "compare");
    EXPECT_EQ(similar_word("comp", words), "compare");
    EXPECT_EQ(similar_word("tu", words), "tune"); // half of the longer word's letters
    EXPECT_EQ(similar_word("t", words), "");
    EXPECT_EQ(similar_word("gaet", words), "gate"); // half of the letters
    EXPECT_EQ(similar_word("xyzzyq", words), "");
    EXPECT_EQ(similar_word("x", {}), "");
}

} // namespace
} // namespace gnomon::scene::test
