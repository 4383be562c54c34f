#include "child_process.hpp"
#include "exr_layers.hpp"
#include "lane.hpp"
#include "temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using Json = nlohmann::json;

const std::vector<std::string> builtins{
    "sphere-cube", "sphere-plane", "yard",  "playground", "two-distances", "tilted-plane", "wall",
    "room",        "lamp-room",    "fence", "terrain",    "columns",       "sphere-field"};

Json compare(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "compare");
    arguments.emplace_back("--json");
    const Ending ending = gnomon(arguments);
    expect_done(ending);
    return ending.exit_code == 0 ? Json::parse(ending.out) : Json::object();
}

/// Expects that the counts of all classes add up to all pixels.
void expect_whole(const Json& result)
{
    const Json& pixels = result.at("pixels");
    std::int64_t sum = 0;
    for (const char* const name : {"background", "unmatched", "attached", "out_of_light",
                                   "indeterminate", "lit", "blocked"}) {
        sum += pixels.at(name).get<std::int64_t>();
    }
    const Json& job = result.at("job");
    EXPECT_EQ(sum, pixels.at("total"));
    EXPECT_EQ(sum, job.at("image.width").get<std::int64_t>() *
                       job.at("image.height").get<std::int64_t>());
}

/// Unmatched pixels among those that show a surface.
double unmatched_share(const Json& result)
{
    const Json& pixels = result.at("pixels");
    const auto surface =
        pixels.at("total").get<std::int64_t>() - pixels.at("background").get<std::int64_t>();
    return pixels.at("unmatched").get<double>() / static_cast<double>(surface);
}

TEST(Comparison, OfEveryBuiltinSeesTheSameSurfacesTwice)
{
    for (const std::string& name : builtins) {
        SCOPED_TRACE(name);
        std::vector<std::string> arguments{"--builtin", name};
        if (!tests::runs_full_tests()) {
            arguments.insert(arguments.end(),
                             {"--set", "image.width=320", "--set", "image.height=180", "--set",
                              "shadow_map.resolution=512"});
        }
        const Json result = compare(arguments);
        expect_whole(result);
        EXPECT_LT(unmatched_share(result), name == "sphere-field" ? 0.03 : 0.01);
    }
}

TEST(Comparison, OfScannedMeshesOnGroundCountsEveryPixel)
{
    const char* const folder = std::getenv("GNOMON_SHARED_SCENES");
    if (folder == nullptr) {
        GTEST_SKIP() << "GNOMON_SHARED_SCENES is not set";
    }
    for (const char* const name : {"bunny.obj", "nefertiti.obj", "suzanne.obj"}) {
        SCOPED_TRACE(name);
        if (!std::filesystem::exists(path{folder} / name)) {
            GTEST_SKIP() << name << " is not in GNOMON_SHARED_SCENES";
        }
        const Json result = compare({path{folder} / name, "--set", "scene.ground=true", "--set",
                                     "image.width=640", "--set", "image.height=360"});
        expect_whole(result);
        EXPECT_GT(result.at("pixels").at("blocked"), 0);
    }
}

TEST(ComparisonJson, HasEveryNameOfTheSchema)
{
    const Json result = compare(small({"--builtin", "sphere-cube"}));
    EXPECT_EQ(result.at("schema"), 2);
    const std::map<std::string, std::vector<std::string>> groups{
        {"pixels",
         {"total", "background", "unmatched", "attached", "out_of_light", "indeterminate", "lit",
          "blocked"}},
        {"unmatched_kinds", {"snap", "tie", "mismatch"}},
        {"indeterminate_kinds", {"silhouette", "vertex", "graze"}},
        {"causes", {"bias", "precision", "resolution", "coverage"}},
        {"labels", {"acne", "peter_panning", "leak", "edge", "overshadow"}},
        {"peter_panning_gap_m", {"median", "p95", "max"}},
        {"bias_curve",
         {"best_interval", "best_errors", "acne_free", "panning_free", "allowances",
          "no_constant_bias_serves"}},
        {"environment", {"gl_renderer", "gl_version", "embree", "gnomon"}},
        {"seconds", {"scene", "bvh", "receivers", "shadow_map", "lookup", "truth", "analysis"}}};
    for (const auto& [group, names] : groups) {
        ASSERT_TRUE(result.contains(group)) << group;
        for (const std::string& name : names) {
            // A group that was not computed is null.
            EXPECT_TRUE(result[group].is_null() || result[group].contains(name)) << group << name;
        }
    }
    for (const char* const name : {"false_shadow", "false_lit", "false_shadow_rate",
                                   "false_lit_rate", "error_rate", "mean_abs_error"}) {
        EXPECT_TRUE(result.at(name).is_number()) << name;
    }
}

TEST(ComparisonJson, LeavesRatesWithoutADenominatorEmpty)
{
    // The closed room has no lit pixel, so none can be shadowed by mistake.
    const Json result = compare(small({"--builtin", "room"}));
    EXPECT_EQ(result.at("pixels").at("lit"), 0);
    EXPECT_TRUE(result.at("false_shadow_rate").is_null());
    EXPECT_TRUE(result.at("false_lit_rate").is_number());
}

struct Result {
    Json json;
    store::ExrLayers layers;
};

Result compare_with_layers(std::vector<std::string> arguments)
{
    const TemporaryFolder folder;
    const path aov = folder.path() / "a.exr";
    arguments.insert(arguments.end(), {"--aov", aov});
    Result result;
    result.json = compare(arguments);
    result.layers = store::read_exr(aov);
    result.json.erase("seconds");
    result.layers.channels.erase("witness"); // any certified triangle may serve as one
    return result;
}

TEST(ComparisonJson, SamplesAmountsWhereAFilterHasNoFormula)
{
    // The usual lane has fewer triangles and reruns.
    const std::string builtin = tests::in_lane("sphere-plane", "columns");
    const std::vector<std::string> job{"--builtin", builtin, "--set", "lookup.filter=hardware"};
    const Json result = compare(small(job));
    EXPECT_EQ(result.at("bias_source"), "curve");
    const Json& curve = result.at("bias_curve");
    EXPECT_EQ(curve.at("amount_ordinate"), "sampled");
    EXPECT_FALSE(curve.at("recommended").is_null());
    const Json& reruns = result.at("bias_reruns");
    ASSERT_GE(reruns.size(), 26U) << "from 0 to 1";
    ASSERT_LE(reruns.size(), 27U + 5U * 64U) << "and around the least error, moved at most 4 times";
    for (std::size_t i = 0; i < reruns.size(); i += reruns.size() / tests::in_lane(2U, 4U)) {
        std::vector<std::string> biased = job;
        biased.insert(biased.end(), {"--set", "bias.constant=" + reruns.at(i).at("bias").dump()});
        const Json alone = compare(small(biased));
        for (const char* const name :
             {"false_shadow", "false_lit", "false_shadow_rate", "shadow_amount", "light_amount"}) {
            EXPECT_EQ(reruns.at(i).at(name), alone.at(name)) << reruns.at(i);
        }
        Json own = alone.at("bias_curve");
        // Sentences name the bias by the job's key, rounded for pasting.
        own["recommended"]["sentences"] = curve.at("recommended").at("sentences");
        EXPECT_EQ(own, curve) << "of whatever bias the job has";
    }
    const Json nearest = compare(small({"--builtin", builtin}));
    EXPECT_EQ(nearest.at("bias_curve").at("amount_ordinate"), "exact");
    EXPECT_TRUE(nearest.at("bias_reruns").is_null());
}

class VerifyFilter : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Filters, VerifyFilter, ::testing::Values("pcf3", "hardware"));

TEST_P(VerifyFilter, HoldsGlsRerunsToTheBiasCurve)
{
    const std::string filter = fmt::format("lookup.filter={}", GetParam());
    const Json result = compare(small({"--builtin", "columns", "--set", filter, "--verify"}));
    const Json& verification = result.at("verification");
    const Json& reruns = verification.at("reruns");
    EXPECT_EQ(verification.at("differences"), 0);
    EXPECT_EQ(verification.at("biases"), reruns.size());
    EXPECT_GE(reruns.size(), 15U) << "at, below and above five critical biases";
    std::int64_t verdicts = 0;
    std::int64_t most_lit = 0;
    for (const Json& rerun : reruns) {
        EXPECT_EQ(rerun.at("differences"), 0) << rerun;
        EXPECT_GE(rerun.at("lit"), most_lit) << "more bias never shadows";
        most_lit = rerun.at("lit").get<std::int64_t>();
        verdicts += most_lit + rerun.at("shadowed").get<std::int64_t>();
    }
    EXPECT_EQ(verification.at("verdicts"), verdicts);
}

TEST(Verify, IsToldWhereItIsAskedFor)
{
    EXPECT_TRUE(compare(small({"--builtin", "columns"})).at("verification").is_null());
    const Ending table = gnomon(small({"compare", "--builtin", "columns", "--verify"}));
    expect_done(table);
    EXPECT_NE(table.out.find(" reruns of GL: 0 of "), std::string::npos) << table.out;
}

TEST(Verify, NeedsTheExactTruth)
{
    expect_refused(gnomon(small({"compare", "--builtin", "wall", "--verify", "--truth", "float"})),
                   2, "--verify needs --truth exact");
}

TEST(Determinism, TheSameJobGivesTheSameBytesOnAnyNumberOfThreads)
{
    for (const char* const builtin : {"columns", "sphere-cube"}) {
        SCOPED_TRACE(builtin);
        if (!tests::runs_full_tests() && builtin == std::string{"columns"}) {
            continue; // the usual lane leaves out the scene of many triangles
        }
        const std::vector<std::string> arguments{"--builtin",       builtin, "--set",
                                                 "image.width=480", "--set", "image.height=270"};
        const Result first = compare_with_layers(arguments);
        ASSERT_GE(first.layers.channels.size(), 9U);
        std::vector<std::string> counts{"1", "2"};
        if (tests::runs_full_tests()) {
            counts.emplace_back("0"); // the default
        }
        for (const std::string& threads : counts) {
            std::vector<std::string> again = arguments;
            again.insert(again.end(), {"--threads", threads});
            const Result second = compare_with_layers(again);
            EXPECT_EQ(first.json, second.json) << threads;
            EXPECT_EQ(first.layers.texts, second.layers.texts) << threads;
            for (const auto& [name, values] : first.layers.channels) {
                EXPECT_TRUE(values == second.layers.channels.at(name)) << name << ", " << threads;
            }
        }
    }
}

TEST(Truth, DoesNotDependOnTheShadowMap)
{
    for (const char* const builtin : {"yard", "sphere-cube"}) {
        const std::vector<std::string> arguments = small({"--builtin", builtin});
        std::size_t number = builtin == std::string{"yard"} ? 0 : 1;
        const Result base = compare_with_layers(arguments);
        const auto& truth = base.layers.channels.at("truth");
        for (const char* const setting :
             {"shadow_map.resolution=333", "shadow_map.depth_format=d16", "bias.constant=0.01",
              "lookup.filter=pcf5", "shadow_map.fit=camera", "shadow_map.roll_deg=30",
              "shadow_map.cull=front", "bias.normal_texels=2"}) {
            if (!tests::runs_full_tests() && number++ % 2 != 0) {
                continue; // the usual lane tries each setting with one scene
            }
            std::vector<std::string> changed = arguments;
            changed.insert(changed.end(), {"--set", setting});
            const Result other = compare_with_layers(changed);
            EXPECT_TRUE(truth == other.layers.channels.at("truth")) << builtin << ", " << setting;
        }
    }
}

TEST(ComparisonResults, SayOfTheRecommendedBiasWhatItLeavesWhereTheLookupIsMoved)
{
    const std::vector<std::string> moved{"--builtin", "two-distances",
                                         "--set",     "image.width=160",
                                         "--set",     "image.height=90",
                                         "--set",     "lookup.filter=pcf3",
                                         "--set",     "shadow_map.resolution=64",
                                         "--set",     "bias.normal_texels=0.7"};
    for (const std::string own : {"0", "0.0005", "-0.01"}) {
        std::vector<std::string> arguments = moved;
        arguments.insert(arguments.end(), {"--set", "bias.constant=" + own});
        const Json said = compare(arguments).at("bias_curve").at("recommended");
        arguments.back() = "bias.constant=" + said.at("bias").dump();
        const Json left = compare(arguments);
        EXPECT_GT(left.at("softening").get<double>(), 0);
        for (const char* const name : {"softening", "shadow_amount", "light_amount"}) {
            // The ninths are summed in another order.
            EXPECT_NEAR(said.at(name).get<double>(), left.at(name).get<double>(), 1e-9)
                << name << ", recommended by a job with the bias " << own;
        }
    }
}

TEST(KeptPixels, HaveTheHeadlineAndTheSettingsOfEngines)
{
    const tests::TemporaryFolder folder;
    const path run = folder / "run";
    const std::vector<std::string> job{"--builtin",      "sphere-plane", "--set",
                                       "image.width=96", "--set",        "image.height=54"};
    std::vector<std::string> words{"compare", "--out", run};
    words.insert(words.end(), job.begin(), job.end());
    expect_done(gnomon(words));
    Json kept;
    for (const auto& entry : std::filesystem::directory_iterator{run / "pixels"}) {
        if (entry.path().extension() == ".json") {
            kept = Json::parse(tests::read_text(entry.path()));
        }
    }
    const std::string headline = kept.at("headline");
    EXPECT_TRUE(std::string{kept.at("findings").at(0)}.starts_with(headline)) << headline;
    // Of the engines that can have a spot light, one is three.js.
    const Json& engines = kept.at("engine_settings");
    const auto three = std::ranges::find(engines, "three", [](const Json& engine) {
        return engine.at("engine").get<std::string>();
    });
    ASSERT_NE(three, engines.end());
    words = {"settings", "--engine", "three", "--json"};
    words.insert(words.end(), job.begin(), job.end());
    EXPECT_EQ(Json::parse(gnomon(words).out).at(0), *three);
}

} // namespace
} // namespace gnomon::testing
