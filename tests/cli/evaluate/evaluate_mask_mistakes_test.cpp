#include "lane.hpp"
#include "mistaken_case.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;

TEST(EvaluateMistakes, NamesAMaskUpsideDown)
{
    expect_named([](CaseFolder& folder) { flip_rows(folder.channels["shadow.V"]); },
                 "the mask is flipped against P: its rows");
}

TEST(EvaluateMistakes, NamesAMaskThatIsTurnedRound)
{
    for (const bool inverts : {false, true}) {
        CaseFolder& folder = case_of("yard");
        folder.keep_level_0();
        auto& mask = folder.channels["shadow.V"];
        change_each(mask, [inverts](float verdict) { return inverts ? 1 - verdict : verdict; });
        std::reverse(mask.data(), mask.data() + mask.pixel_count());
        folder.write();
        const std::string out = folder.evaluate({"--check"}).out;
        EXPECT_THAT(out, HasSubstr("flipped against P: its rows and columns"));
        EXPECT_EQ(out.find("and it is inverted") != std::string::npos, inverts) << out;
    }
}

TEST(EvaluateMistakes, NamesAnInvertedMask)
{
    expect_named(
        [](CaseFolder& folder) {
            auto& mask = folder.channels["shadow.V"];
            for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
                mask[i] = 1 - mask[i];
            }
        },
        "the mask is inverted");
}

TEST(EvaluateMistakes, NamesALightThatShinesTheOtherWay)
{
    const std::map<std::string, std::string> reversed{
        {"yard", "[-20.1346, 37.1572, 26.7196]"}, {"terrain", "[-0.906923, 0.207912, 0.366421]"}};
    for (const auto& [scene, direction] : reversed) {
        for (const bool knows_eye : {true, false}) {
            if (!tests::runs_full_tests() && knows_eye != (scene == "yard")) {
                continue; // the usual lane tries each scene and each knowledge once
            }
            CaseFolder& folder = case_of(scene);
            folder.keep_level_0();
            folder.drop_table("light");
            folder.toml += fmt::format("\n[light]\ndirection = {}\n", direction);
            if (!knows_eye) {
                folder.drop_table("camera");
            }
            folder.write();
            expect_refused(folder.evaluate(), 2, "the light seems to shine the other way");
        }
    }
}

/// Replaces the mask by diffuse shading, N·L without shadows.
void switch_shadows_off(CaseFolder& folder, float x, float y, float z, bool is_directional)
{
    auto& channels = folder.channels;
    auto& mask = channels["shadow.V"];
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        const float at = is_directional ? 0.0F : 1.0F;
        const float light = channels["Ng.X"][i] * (x - at * channels["P.X"][i]) +
                            channels["Ng.Y"][i] * (y - at * channels["P.Y"][i]) +
                            channels["Ng.Z"][i] * (z - at * channels["P.Z"][i]);
        mask[i] = std::max(0.0F, light);
    }
    folder.toml += "\n[channels]\nlit_above = 0\n";
}

TEST(EvaluateMistakes, TakeAPictureWithoutShadowsForNoMistake)
{
    const std::map<std::string, std::pair<std::vector<float>, bool>> lights{
        {"sphere-plane", {{}, false}}, {"yard", {{-20.1346F, 37.1572F, 26.7196F}, true}}};
    for (const auto& [scene, light] : lights) {
        for (const bool knows_side : {true, false}) {
            if (!tests::runs_full_tests() && knows_side != (scene == "yard")) {
                continue; // the usual lane tries each scene and each knowledge once
            }
            CaseFolder& folder = case_of(scene);
            float place[3] = {};
            if (light.second) {
                std::copy(light.first.begin(), light.first.end(), place);
            } else {
                const std::size_t at = folder.toml.find("position = [") + 12;
                ASSERT_EQ(std::sscanf(folder.toml.c_str() + at, "%f, %f, %f", &place[0], &place[1],
                                      &place[2]),
                          3);
            }
            for (const char* const table : {"shadow_map", "lookup", "bias"}) {
                folder.drop_table(table);
            }
            switch_shadows_off(folder, place[0], place[1], place[2], light.second);
            if (!knows_side) {
                folder.keep_level_0();
                folder.drop_table("camera");
            }
            folder.write();
            const Ending checked = folder.evaluate({"--check"});
            EXPECT_EQ(checked.exit_code, 0) << scene << checked.out << checked.err;
            EXPECT_THAT(checked.out, HasSubstr("Warning: the mask shows no cast shadow")) << scene;
        }
    }
}

TEST(EvaluateMistakes, ProposeNoLightForAMaskOfOneKind)
{
    for (const std::string& scene : mistaken_scenes) {
        for (const float verdict : {0.0F, 1.0F}) {
            if (!tests::runs_full_tests() && (verdict == 0) != (scene == "sphere-plane")) {
                continue; // the usual lane tries each scene and each kind once
            }
            CaseFolder& folder = case_of(scene);
            folder.keep_level_0();
            folder.drop_table("camera");
            change_each(folder.channels["shadow.V"], [verdict](float) { return verdict; });
            folder.write();
            EXPECT_EQ(folder.evaluate({"--check"}).exit_code, 0) << scene << verdict;
        }
    }
}

TEST(EvaluateMistakes, NameALightWithOtherAxes)
{
    CaseFolder& folder = case_of("yard");
    folder.keep_level_0();
    folder.drop_table("light");
    folder.toml += "\n[light]\ndirection = [20.1346, -26.7196, 37.1572]\n";
    folder.write();
    expect_refused(folder.evaluate(), 2, "the mask fits a light with the axes");
}

TEST(EvaluateMistakes, WarnOfAMaskThatSaysNothing)
{
    CaseFolder& folder = case_of("yard");
    change_each(folder.channels["shadow.V"], [](float) { return 1.0F; });
    folder.write();
    const Ending checked = folder.evaluate({"--check"});
    EXPECT_EQ(checked.exit_code, 0);
    EXPECT_THAT(checked.out, HasSubstr("Warning: mask and truth agree no better than by chance"));
    EXPECT_THAT(folder.evaluate({"--verbose"}).out, HasSubstr("Warning: mask and truth"));
    EXPECT_THAT(folder.evaluate().out, HasSubstr("\nwarning   Mask and truth agree no better"));
    EXPECT_THAT(folder.evaluate({"--json"}).out, HasSubstr("\"warning\": \"mask and truth"));
}

/// The counts of errors in what `evaluate --json` prints.
std::pair<std::uint64_t, std::uint64_t> errors_of(const CaseFolder& folder)
{
    const Ending ending = folder.evaluate({"--json"});
    EXPECT_EQ(ending.exit_code, 0) << ending.err;
    const auto json = nlohmann::json::parse(ending.out, nullptr, false);
    return {json.at("false_shadow").get<std::uint64_t>(),
            json.at("false_lit").get<std::uint64_t>()};
}

TEST(EvaluateMistakes, NameAMaskOfTwoOtherValuesAndHowToReadIt)
{
    CaseFolder& folder = case_of(tests::in_lane("sphere-plane", "yard"));
    folder.keep_level_0();
    folder.write();
    const auto own = errors_of(folder);
    const auto mask = folder.channels["shadow.V"];
    const std::string toml = folder.toml;
    for (const auto& [dark, bright, range] :
         {std::tuple{0.7F, 1.0F, "[0.7, 1]"}, std::tuple{0.25F, 0.875F, "[0.25, 0.875]"},
          std::tuple{1.0F, 0.5F, "[1, 0.5]"}}) {
        folder.channels["shadow.V"] = mask;
        change_each(folder.channels["shadow.V"],
                    [&](float v) { return v >= 0.5F ? bright : dark; });
        for (const char* const more : {"", "\n[channels]\nfractions = true\n"}) {
            if (!tests::runs_full_tests() && (*more == '\0') != (bright == 0.875F)) {
                continue; // the usual lane reads each mask one way
            }
            folder.toml = toml + more;
            folder.write();
            const Ending checked = folder.evaluate({"--check"});
            EXPECT_EQ(checked.exit_code, 1) << range << checked.out;
            EXPECT_THAT(checked.out, HasSubstr(std::string{"set channels.mask_range = "} + range));
        }
        if (tests::runs_full_tests() || bright == 0.875F) {
            expect_refused(folder.evaluate(), 2, "the mask is ");
        }
        folder.toml = toml + "\n[channels]\nmask_range = " + range + "\n";
        folder.write();
        EXPECT_EQ(errors_of(folder), own) << range;
    }
}

TEST(EvaluateMistakes, NameAMaskThatIsMultipliedWithTheCosine)
{
    CaseFolder& folder = case_of("yard");
    auto& mask = folder.channels["shadow.V"];
    const float length = std::hypot(20.1346F, 37.1572F, 26.7196F);
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        const float light = -20.1346F * folder.channels["Ng.X"][i] +
                            37.1572F * folder.channels["Ng.Y"][i] +
                            26.7196F * folder.channels["Ng.Z"][i];
        mask[i] = std::isnan(light) ? 0.0F : mask[i] * std::max(0.0F, light / length);
    }
    folder.keep_level_0();
    const std::string toml = folder.toml;
    for (const char* const more : {"", "\n[channels]\nfractions = true\n"}) {
        folder.toml = toml + more;
        folder.write();
        const Ending checked = folder.evaluate({"--check"});
        EXPECT_EQ(checked.exit_code, 1) << checked.out;
        EXPECT_THAT(checked.out, HasSubstr("times the cosine of its angle (N·L)"));
    }
    expect_refused(folder.evaluate(), 2, "set channels.lit_above = 0");
    folder.toml = toml + "\n[channels]\nlit_above = 0\n";
    folder.write();
    EXPECT_EQ(folder.evaluate().exit_code, 0);
}

TEST(EvaluateMistakes, DoNotWarnOfShadowsThatAreTooLightToCount)
{
    CaseFolder& folder = case_of("yard");
    folder.keep_level_0();
    change_each(folder.channels["shadow.V"], [](float v) { return 0.75F + v / 4; });
    folder.toml += "\n[channels]\nmask_range = [0, 1]\n"; // declared in the case
    folder.write();
    const std::string out = folder.evaluate({"--json"}).out;
    EXPECT_THAT(out, HasSubstr("\"agreement\": 0.0,"));
    EXPECT_THAT(out, HasSubstr("\"warning\": null"));
}

TEST(EvaluateMistakes, WarnWhereNothingIsScored)
{
    CaseFolder& folder = case_of("sphere-plane");
    folder.keep_level_0();
    folder.drop_table("camera");
    folder.toml += "\n[camera]\neye = [0, -5, 0]\n"; // below the ground, turned from the light
    auto& valid = folder.channels["valid"];
    for (std::size_t i = 0; i < valid.pixel_count(); ++i) {
        valid[i] = folder.channels["P.Y"][i] == 0 ? valid[i] : 0.0F;
    }
    folder.write();
    EXPECT_THAT(folder.evaluate({"--check"}).out, HasSubstr("Warning: no pixel is scored"));
}

TEST(EvaluateMistakes, NamesAnAntiAliasedMask)
{
    expect_named(
        [](CaseFolder& folder) {
            auto& mask = folder.channels["shadow.V"];
            const auto [width, height] = mask.size();
            for (int y = 0; y + 1 < height; ++y) {
                for (int x = 0; x + 1 < width; ++x) {
                    mask(x, y) =
                        (mask(x, y) + mask(x + 1, y) + mask(x, y + 1) + mask(x + 1, y + 1)) / 4;
                }
            }
        },
        "the mask is anti-aliased");
}

TEST(EvaluateMistakes, AreNotSeenInShadowsThatAreMerelyBad)
{
    const std::vector<std::vector<std::string>> settings{
        {},
        {"--set", "bias.constant=0"},          // acne everywhere
        {"--set", "bias.constant=0.9"},        // nothing is shadowed
        {"--set", "bias.constant=-0.01"},      // nearly everything is
        {"--set", "shadow_map.resolution=16"}, // shadows of other shapes
        {"--set", "lookup.filter=pcf9", "--set", "shadow_map.resolution=64"},
    };
    // The usual lane tries each setting in one scene.
    std::vector<std::string> scenes{"wall", "room"};
    if (tests::runs_full_tests()) {
        scenes.emplace_back("sphere-plane");
    }
    for (std::size_t i = 0; i < scenes.size() * settings.size(); ++i) {
        const std::string& scene = scenes[i / settings.size()];
        const auto& more = settings[i % settings.size()];
        if (tests::runs_full_tests() ||
            i % settings.size() % scenes.size() == i / settings.size()) {
            const CaseFolder folder{scene, more};
            const Ending ending = folder.evaluate({"--check"});
            EXPECT_EQ(ending.exit_code, 0) << folder.compared.command << "\n"
                                           << ending.out << ending.err;
        }
    }
}

} // namespace
} // namespace gnomon::testing
