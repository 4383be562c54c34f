#include "gate_folder.hpp"

#include "store/baseline/pixel_mask.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

constexpr const char* junit_schema = GNOMON_ROOT "/tests/cli/gate/junit.xsd";

using store::ExampleRun;
using ::testing::AllOf;
using ::testing::HasSubstr;
using NewPixelsJson = nlohmann::json;

/// A horizontal sheet over ground, as an OBJ file, moved sideways.
std::string sheet_over_ground(double moved_m)
{
    return fmt::format("o ground\nv -4 0 4\nv 4 0 4\nv 4 0 -4\nv -4 0 -4\nf 1 2 3 4\n"
                       "o sheet\nv {0} 1 1\nv {1} 1 1\nv {1} 1 -1\nv {0} 1 -1\nf 5 6 7 8\n",
                       moved_m - 1, moved_m + 1);
}

/// A light straight above; texels of 1/16 m with borders at multiples of it.
const std::string sheet_job = R"(
image.width = 640
image.height = 360
scene.file = "scene.obj"
camera = {eye = [0, 6, 5], target = [0, 0, 0]}
light = {type = "directional", direction = [0, -1, 0], position = [0, 5, 0]}
shadow_map = {resolution = 128, fit = "fixed", half_extent = 4, near = 0.5, far = 10}
bias.constant = 1e-3
)";

/// A job of a scene file in the folder, compared.
Ending compare_file(const GateFolder& folder, const std::string& run)
{
    return gnomon({"compare", folder.at("job.toml"), "--out", folder.at(run)});
}

TEST(GateCommand, FindsAnOccluderMovedByHalfATexel)
{
    constexpr double texel_m = 1.0 / 16;
    const GateFolder folder;
    folder.write("job.toml", sheet_job);
    // Just beyond the border of a texel, so that no texel's centre lies on the sheet's edge.
    folder.write("scene.obj", sheet_over_ground(0.02 * texel_m));
    ASSERT_EQ(compare_file(folder, "before").exit_code, 0);
    expect_done(folder.save("before"));
    folder.write("scene.obj", sheet_over_ground(0.52 * texel_m));
    ASSERT_EQ(compare_file(folder, "after").exit_code, 0);
    const Ending ending = folder.gate("after", {"--json"});
    EXPECT_EQ(ending.exit_code, 1) << ending.err;
    const NewPixelsJson found = NewPixelsJson::parse(ending.out);
    const NewPixelsJson& worst = found.at("findings").at(0);
    EXPECT_EQ(worst.at("dominant_cause"), "resolution");
    EXPECT_GE(worst.at("now").get<int>() - worst.at("baseline").get<int>(), 100) << worst;
    EXPECT_EQ(worst.at("changed_parameters").at(0).at("key"), "scene_hash");
    EXPECT_TRUE(std::filesystem::exists(worst.at("picture").get<std::string>())) << worst;
    const auto of_ground =
        std::find_if(found.at("findings").begin(), found.at("findings").end(),
                     [](const NewPixelsJson& one) { return one.at("where").contains("object"); });
    ASSERT_NE(of_ground, found.at("findings").end());
    EXPECT_EQ(of_ground->at("where").at("object"), "ground");
}

/// A run whose only configuration has its wrong pixels in other places than the baseline's.
void plant_moved_pixels(const GateFolder& folder)
{
    folder.compare("before", {});
    expect_done(folder.save("before"));
    ASSERT_EQ(folder.masks().size(), 1U);
    // The mask upside down: other pixels, same totals.
    NewPixelsJson baseline = NewPixelsJson::parse(text_of(folder.at("baseline.json")));
    NewPixelsJson& name = baseline.at("configurations").at(0).at("wrong_pixels");
    const std::filesystem::path file = folder.at("baseline.json");
    const auto mask = store::read_mask(file, name.get<std::string>(), {320, 180});
    analysis::PixelMask flipped{mask.size()};
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        flipped[i] = mask[mask.pixel_count() - 1 - i];
    }
    name = store::write_mask(file, flipped);
    folder.write("baseline.json", baseline.dump());
}

TEST(NewPixels, AreARegressionWhereNoTotalIs)
{
    const GateFolder folder;
    plant_moved_pixels(folder);
    const Ending ending = folder.gate("before");
    EXPECT_EQ(ending.exit_code, 1) << ending.err;
    EXPECT_THAT(ending.out, AllOf(HasSubstr("1 rule broken"), HasSubstr("new_pixels"),
                                  HasSubstr("gate/01-new_pixels.png")));
    const Ending elsewhere = folder.gate("before", {"--pictures", folder.at("pictures")});
    EXPECT_THAT(elsewhere.out, HasSubstr(folder.at("pictures") + "/01-new_pixels.png"));
    EXPECT_TRUE(std::filesystem::exists(folder.at("pictures/01-new_pixels.png")));
    EXPECT_THAT(elsewhere.err, HasSubstr("wrote " + folder.at("pictures") + "/gate.html"));
    EXPECT_THAT(text_of(folder.at("pictures/gate.html")),
                AllOf(HasSubstr("Pixels that were wrong in the baseline"),
                      HasSubstr("Pixels that became wrong"), HasSubstr("new pixels: ")));
    const Ending refused =
        folder.gate("before", {"--pictures", folder.at("baseline.json/pictures")});
    expect_refused(refused, 4, "baseline.json/pictures");
}

TEST(NewPixels, CannotBeToldWithoutPixels)
{
    const GateFolder folder;
    folder.compare("run", {});
    expect_done(folder.save("run"));
    std::filesystem::remove_all(folder.at("run/pixels"));
    const Ending ending = folder.gate("run", {"--json"});
    EXPECT_EQ(ending.exit_code, 5) << ending.err;
    const NewPixelsJson finding = NewPixelsJson::parse(ending.out).at("findings").at(0);
    EXPECT_EQ(finding.at("reason"), "not_available");
    EXPECT_EQ(finding.at("obstacle"), "the run did not keep its pixels");
    // A baseline without masks does not fix places; only a rule requires them.
    expect_done(folder.save("run"));
    EXPECT_TRUE(folder.masks().empty());
    expect_done(folder.gate("run"));
    folder.write("gate.toml", "[[rule]]\nid = \"a\"\nmetric = \"new_pixels\"\nallow_pixels = 0\n");
    EXPECT_EQ(folder.gate("run", {"--rules", folder.at("gate.toml")}).exit_code, 5);
}

TEST(NewPixels, OfAnotherImageSizeCannotBeTold)
{
    const GateFolder folder;
    folder.compare("run", {});
    expect_done(folder.save("run"));
    folder.compare("smaller", {"--set", "image.width=160"});
    folder.write("gate.toml", "[[rule]]\nid = \"a\"\nmetric = \"new_pixels\"\nallow_pixels = 0\n");
    const Ending ending = folder.gate("smaller", {"--rules", folder.at("gate.toml")});
    EXPECT_EQ(ending.exit_code, 5) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("the image is 160x180 pixels, the baseline's 320x180"));
}

TEST(Masks, ThatAreMissingOrDamagedNeverPass)
{
    const GateFolder folder;
    folder.compare("run", {});
    expect_done(folder.save("run"));
    const std::filesystem::path mask = folder.masks().at(0);
    const std::string bytes = text_of(mask);
    const auto gate_with = [&](const std::string& text) {
        std::ofstream{mask, std::ios::binary} << text;
        return folder.gate("run");
    };
    expect_refused(gate_with(bytes.substr(0, bytes.size() / 2)), 2, "damaged or truncated");
    expect_refused(gate_with(""), 2, "not a PNG image, or truncated");
    std::string altered = bytes;
    altered[altered.size() / 2] = static_cast<char>(altered[altered.size() / 2] ^ 1);
    expect_refused(gate_with(altered), 2, mask.filename().string());
    expect_done(gate_with(bytes));
    std::filesystem::remove(mask);
    expect_refused(folder.gate("run"), 3, "mask of wrong pixels is missing");
}

TEST(GateUpdate, TakesResultsAndPrintsWhatChanges)
{
    const GateFolder folder;
    const ExampleRun run{2, 3};
    run.compute(folder.at("run"));
    record_example(folder.at("worse"), run,
                   [](auto&, auto& curves) { add_leak(curves[1].rows[2].result); });
    const Ending made = folder.gate("run", {"--update", "missing"});
    expect_done(made);
    EXPECT_THAT(made.out,
                HasSubstr("baseline.json: 6 configurations, without masks of wrong pixels\n"));
    EXPECT_EQ(folder.gate("worse").exit_code, 1);
    EXPECT_THAT(folder.gate("worse", {"--update", "missing"}).out,
                HasSubstr("0 of 6 configurations differ"));
    EXPECT_EQ(folder.gate("worse").exit_code, 1) << "it was not missing";
    EXPECT_THAT(folder.gate("worse", {"--update", "changed"}).out,
                AllOf(HasSubstr("false_lit"), HasSubstr("1 of 6 configurations differ")));
    expect_done(folder.gate("worse"));
    ExampleRun{1, 3}.compute(folder.at("fewer"));
    EXPECT_THAT(folder.gate("fewer", {"--update", "all"}).out,
                HasSubstr("0 of 3 configurations differ, 3 missing, 0 new\n"))
        << "what is not there any more is named as missing";
}

TEST(GateUpdate, IsRefusedInABuildUnlessAllowed)
{
    const GateFolder folder;
    ExampleRun{1, 1}.compute(folder.at("run"));
    Start build;
    build.environment = {"CI=true"};
    std::vector<std::string> update{
        "gate", folder.at("run"), "--baseline", folder.at("baseline.json"), "--update", "all"};
    expect_refused(gnomon(update, build), 2, "--allow-ci-update");
    EXPECT_FALSE(std::filesystem::exists(folder.at("baseline.json")));
    update.emplace_back("--allow-ci-update");
    expect_done(gnomon(update, build));
    EXPECT_TRUE(std::filesystem::exists(folder.at("baseline.json")));
}

TEST(GateUpdate, RefusesAnotherEnvironmentUnlessAllIsReplaced)
{
    const GateFolder folder;
    const ExampleRun run{1, 2};
    run.compute(folder.at("run"));
    record_example(folder.at("other"), run, [](auto& description, auto&) {
        description.environment.gl_renderer = "radeonsi";
    });
    expect_done(folder.save("run"));
    expect_refused(folder.gate("other", {"--update", "changed"}), 3, "--update all");
    const Ending all = folder.gate("other", {"--update", "all"});
    expect_done(all);
    EXPECT_THAT(all.out, HasSubstr("renderer: llvmpipe"));
    expect_done(folder.gate("other"));
    expect_refused(folder.gate("run", {"--update", "some"}), 2, "--update");
}

TEST(GateRules, JudgePointsOfTheCurve)
{
    const GateFolder folder;
    const ExampleRun run{1, 1};
    run.compute(folder.at("run"));
    folder.write("gate.toml",
                 "[[rule]]\nid = \"a\"\nmetric = \"bias_curve.at(1e-6).false_shadow\"\n"
                 "allow_pixels = 0\n");
    const std::vector<std::string> rules{"--rules", folder.at("gate.toml")};
    expect_done(folder.save("run"));
    EXPECT_EQ(folder.gate("run", rules).exit_code, 5) << "the baseline does not know that point";
    expect_done(folder.save("run", rules));
    expect_done(folder.gate("run", rules));
    record_example(folder.at("worse"), run,
                   [](auto&, auto& curves) { ++curves[0].curve.points[0].counts.false_shadow; });
    EXPECT_THAT(folder.gate("worse", rules).out,
                HasSubstr("bias_curve.at(1e-06).false_shadow         1,000        1,001"));
}

TEST(GateOutputs, AreJunitThatTheSchemaKnows)
{
    const GateFolder folder;
    const ExampleRun run{2, 2};
    run.compute(folder.at("run"));
    record_example(folder.at("worse"), run,
                   [](auto&, auto& curves) { ++curves[1].rows[1].result.metrics.false_lit; });
    ExampleRun{1, 2}.compute(folder.at("fewer"));
    expect_done(folder.save("run"));
    if (!is_installed("xmllint")) {
        GTEST_SKIP() << "xmllint (libxml2-utils) is not installed";
    }
    for (const char* const name : {"run", "worse", "fewer"}) {
        (void)folder.gate(name, {"--junit", folder.at("gate.xml")});
        const Ending valid = gnomon::testing::run(
            {"xmllint", "--noout", "--schema", junit_schema, folder.at("gate.xml")});
        EXPECT_EQ(valid.exit_code, 0) << name << valid.err << text_of(folder.at("gate.xml"));
    }
}

TEST(GateOutputs, AnnotateABuildAndAppendASummary)
{
    const GateFolder folder;
    const ExampleRun run{2, 2};
    run.compute(folder.at("run"));
    record_example(folder.at("worse"), run,
                   [](auto&, auto& curves) { ++curves[1].rows[1].result.metrics.false_lit; });
    expect_done(folder.save("run"));
    folder.write("summary.md", "before\n");
    Start build;
    build.environment = {"GITHUB_STEP_SUMMARY=" + folder.at("summary.md")};
    const Ending ending = folder.gate("worse", {"--github"}, build);
    EXPECT_EQ(ending.exit_code, 1);
    EXPECT_THAT(ending.out, HasSubstr("\n::error title=gnomon gate%2C noon%2C bias.constant = "));
    // Names in the table are not run as workflow commands.
    std::smatch stop;
    ASSERT_TRUE(std::regex_search(ending.out, stop,
                                  std::regex{"^::stop-commands::(gnomon-[0-9a-f]{32})\n"}));
    const std::string resumed = "\n::" + stop[1].str() + "::\n";
    EXPECT_LT(ending.out.find("REGRESSION"), ending.out.find(resumed));
    EXPECT_LT(ending.out.find(resumed), ending.out.find("\n::error"));
    EXPECT_EQ(folder.gate("worse", {"--github"}, build).out.find(stop[1].str()), std::string::npos)
        << "the word is another each time";
    EXPECT_THAT(text_of(folder.at("summary.md")),
                AllOf(HasSubstr("before\n### gnomon gate\n"), HasSubstr("| **fail** | noon, ")));
    folder.write("summary.md", std::string(999'900, 'x'));
    (void)folder.gate("worse", {"--github"}, build);
    EXPECT_LE(std::filesystem::file_size(folder.at("summary.md")), 1U << 20U);
    expect_refused(folder.gate("worse", {"--github", "--json"}), 2, "--json");
}

/// The program's commands in an example: those that begin a line or a list's entry.
std::vector<std::vector<std::string>> example_commands(const std::string& text)
{
    static const std::regex command{R"((?:^|\n)(?:#| |-|run:)*(gnomon [^\n]*))"};
    std::vector<std::vector<std::string>> commands;
    for (std::sregex_iterator i{text.begin(), text.end(), command}; i != std::sregex_iterator{};
         ++i) {
        std::istringstream stream{(*i)[1].str().substr(7)};
        std::vector<std::string> words;
        for (std::string word; stream >> word;) {
            words.push_back(word);
        }
        commands.push_back(words);
    }
    return commands;
}

TEST(ContinuousIntegrationExamples, DoWhatTheySay)
{
    for (const char* const name : {"github.yml", "gitlab.yml"}) {
        const std::string text = text_of(std::filesystem::path{GNOMON_ROOT "/examples/ci"} / name);
        EXPECT_EQ(text.find('\t'), std::string::npos) << "YAML takes no tabs";
        const GateFolder folder;
        folder.write("shadows.toml", "scene.builtin = \"sphere-plane\"\nimage.width = 64\n"
                                     "image.height = 36\n[sweep]\n\"bias.constant\" = [0, 0.1]\n");
        std::vector<std::string> done;
        for (std::vector<std::string> words : example_commands(text)) {
            done.push_back(words.front());
            for (std::string& word : words) {
                const bool is_file =
                    word.find('.') != std::string::npos || word == "run" || word == "pictures";
                word = is_file ? folder.at(word) : word;
            }
            const Ending ending = gnomon(words);
            EXPECT_EQ(ending.exit_code, 0) << ending.command << ending.err;
        }
        EXPECT_EQ(done, (std::vector<std::string>{"sweep", "baseline", "doctor", "sweep", "gate"}))
            << name;
        EXPECT_TRUE(std::filesystem::exists(folder.at("shadows.json.masks")));
        if (gnomon::testing::run({"python3", "-c", "import yaml"}).exit_code == 0) {
            const Ending parsed = gnomon::testing::run(
                {"python3", "-c", "import sys, yaml; yaml.safe_load(open(sys.argv[1]))",
                 std::string{GNOMON_ROOT "/examples/ci/"} + name});
            EXPECT_EQ(parsed.exit_code, 0) << parsed.err;
        }
    }
}

} // namespace
} // namespace gnomon::testing
