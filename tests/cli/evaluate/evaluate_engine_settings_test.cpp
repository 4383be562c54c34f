#include "case_folder.hpp"
#include "lane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// Engines' settings in a case: offsets along smooth normals, linear depth.
namespace gnomon::testing {
namespace {

using EngineJson = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

EngineJson judged(const CaseFolder& folder)
{
    const Ending ending = folder.evaluate({"--json"});
    EXPECT_EQ(ending.exit_code, 0) << ending.command << ending.err;
    return EngineJson::parse(ending.out, nullptr, false);
}

std::vector<std::string> set(const std::vector<std::string>& keys)
{
    std::vector<std::string> arguments;
    for (const std::string& key : keys) {
        arguments.insert(arguments.end(), {"--set", key});
    }
    return arguments;
}

const std::vector<std::string> along_vertices{"bias.normal_texels=1.5", "bias.normal_from=vertices",
                                              "bias.constant=0.001", "shadow_map.resolution=256"};

TEST(EvaluateEngineSettings, GiveTheCountsOfCompare)
{
    const std::vector<std::pair<std::string, std::vector<std::string>>> trips{
        {"sphere-cube", along_vertices},
        {"playground", {"bias.normal_m=0.02", "bias.normal_from=vertices", "lookup.filter=pcf3"}},
        {"sphere-plane", {"shadow_map.content=linear", "lookup.filter=linear"}},
        {"lamp-room", {"shadow_map.content=linear", "lookup.filter=pcf3", "bias.normal_texels=1"}},
        {"sphere-plane",
         {"method.name=pcf", "method.pattern=vogel_areas", "method.taps=5", "method.turned=true"}},
    };
    for (const auto& [scene, keys] : trips) {
        if (!tests::runs_full_tests() &&
            (scene == "playground" || keys.front() == "shadow_map.content=linear") &&
            scene != "lamp-room") {
            continue; // other scenes and tests cover this in the usual lane
        }
        const CaseFolder folder{scene, set(keys)};
        const EngineJson own = EngineJson::parse(folder.compared.out);
        const EngineJson back = judged(folder);
        for (const char* const name : {"false_shadow", "false_lit", "error_rate", "mean_abs_error",
                                       "causes", "labels", "peter_panning_gap_m", "bias_curve"}) {
            EXPECT_EQ(own.at(name), back.at(name)) << folder.compared.command << "\n" << name;
        }
        EXPECT_GT(own.at("false_shadow").get<int>() + own.at("false_lit").get<int>(), 20)
            << folder.compared.command;
        const EngineJson& said = back.at("evaluate");
        EXPECT_TRUE(said.at("cannot_know").empty()) << folder.compared.command << said;
        EXPECT_TRUE(said.at("import_check").at("warning").is_null())
            << folder.compared.command << said;
    }
}

TEST(EvaluateEngineSettings, OfBilinearTapsGiveTheCausesOfCompare)
{
    CaseFolder folder{"sphere-plane",
                      set({"method.name=pcf", "method.pattern=vogel_areas", "method.taps=5",
                           "method.radius_texels=1.5", "method.tap=bilinear", "method.turned=true",
                           tests::in_lane("image.width=160", "image.width=240"),
                           tests::in_lane("image.height=90", "image.height=136")})};
    const EngineJson own = EngineJson::parse(folder.compared.out);
    EngineJson back = judged(folder);
    for (const char* const name :
         {"false_shadow", "false_lit", "causes", "labels", "cause_amounts", "shadow_amount"}) {
        EXPECT_EQ(own.at(name), back.at(name)) << name;
    }
    // Predictions for other biases from the recorded case equal GL's results.
    for (const char* const name : {"best_interval", "best_errors", "acne_free"}) {
        EXPECT_EQ(own.at("bias_curve").at(name), back.at("bias_curve").at(name)) << name;
    }
    EXPECT_EQ(own.at("bias_curve").at("recommended").at("bias"),
              back.at("bias_curve").at("recommended").at("bias"));
    EXPECT_GT(own.at("causes").at("filter").get<int>() +
                  own.at("causes").at("resolution").get<int>(),
              20);
    // Taps at other places belong to another filter; without them causes are unknown.
    folder.channels.erase("kernel_axis.X");
    folder.channels.erase("kernel_axis.Y");
    folder.write();
    back = judged(folder);
    EXPECT_THAT(back.at("evaluate").at("cannot_know").dump(),
                HasSubstr("kernel_axis.X and kernel_axis.Y"));
    EXPECT_EQ(own.at("false_shadow"), back.at("false_shadow"));
}

TEST(EvaluateEngineSettings, OfBilinearTapsHoldTheirCurveBesideTheNormalToo)
{
    const CaseFolder folder{"sphere-plane",
                            set({"method.name=pcf", "method.pattern=vogel_areas", "method.taps=5",
                                 "method.tap=bilinear", "method.turned=true", "bias.normal_m=0.05",
                                 tests::in_lane("image.width=120", "image.width=240"),
                                 tests::in_lane("image.height=68", "image.height=136")})};
    const TemporaryFolder out;
    const std::string run = (out.path() / "run").string();
    const Ending ending = folder.evaluate({"--out", run});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    // Without a constant bias, the lookup is still offset from the receiver.
    EXPECT_THAT(gnomon({"status", run}).out, Not(HasSubstr("differ")));
}

TEST(EvaluateEngineSettings, OfAMethodThatComparesNoDepthsHaveNoCauses)
{
    CaseFolder folder{"sphere-plane", {}};
    folder.replace("[lookup]\nfilter = \"nearest\"\n", "[method]\nname = \"vsm\"\n[lookup]\n");
    folder.write();
    EXPECT_THAT(judged(folder).at("evaluate").at("cannot_know").dump(),
                HasSubstr("a method whose verdict follows from depths of a map"));
}

TEST(EvaluateEngineSettings, SayWhichNormalsAnOffsetFollows)
{
    // Shafts with few faces, whose normals differ much from those at their edges.
    CaseFolder folder{"columns", set({"bias.normal_texels=4", "bias.normal_from=vertices"})};
    const EngineJson own = judged(folder);
    folder.replace("normal_from = \"vertices\"", "normal_from = \"geometry\"");
    folder.write();
    const EngineJson other = judged(folder);
    EXPECT_THAT(other.at("evaluate").at("import_check").at("warning").get<std::string>(),
                HasSubstr("along those of the vertices they fit: say bias.normal_from = "
                          "\"vertices\""));
    EXPECT_EQ(other.at("causes"), own.at("causes")) << "they start from the unmoved lookup";
    folder.restore();
    folder.replace("normal_texels = 4", "normal_texels = 6");
    folder.write();
    EXPECT_THAT(judged(folder).at("evaluate").at("import_check").at("warning").get<std::string>(),
                HasSubstr("correct the keys of [bias], or the normals of the mesh"));
}

TEST(EvaluateEngineSettings, HaveNoCausesWhereDepthIsSaidToBeAnother)
{
    CaseFolder folder{"sphere-plane", set({"shadow_map.content=linear"})};
    folder.replace("content = \"linear\"\n", "");
    folder.write();
    EXPECT_THAT(judged(folder).at("evaluate").at("cannot_know").dump(),
                HasSubstr("the shadow map's frustum as it was"));
}

TEST(EvaluateEngineSettings, ThatDoNotGoTogetherAreRefusedInOneLine)
{
    const auto refused = [](const std::vector<std::string>& keys, const std::string& text) {
        expect_refused(gnomon(with({"compare", "--builtin", "sphere-plane"}, set(keys))), 2, text);
    };
    refused({"shadow_map.content=linear", "shadow_map.reversed=true"},
            "is for depth, not for linear depth");
    refused({"shadow_map.content=linear", "bias.receiver_plane=analytic"},
            "shadow_map.content is \"linear\"; remove one of them");
    refused({"shadow_map.content=linear", "method.name=vsm"},
            "remove shadow_map.content = \"linear\"");
    refused({"bias.normal_from=vertex"}, "bias.normal_from");
    expect_refused(
        gnomon(with({"compare", "--builtin", "yard"}, set({"shadow_map.content=linear"}))), 2,
        "depth is linear already");
}

} // namespace
} // namespace gnomon::testing
