// Regressions without a change in counts, and runs with nothing to count.

#include "gate_folder.hpp"
#include "lane.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;
using GateJson = nlohmann::json;

/// A plane tilted from a directional light, under a filter kernel.
struct Tilt {
    int angle_deg;
    std::string filter;
    int width; ///< of the kernel

    /// The settings with a bias of `texels` · texel width · tan θ.
    /// @param texel_m  a texel's width.
    [[nodiscard]] std::vector<std::string> settings(double texel_m, double texels) const
    {
        const double bias_m = texels * texel_m * std::tan(angle_deg * std::numbers::pi / 180);
        return {"--set", "image.width=96",
                "--set", "image.height=54",
                "--set", "shadow_map.resolution=512",
                "--set", fmt::format("scene.tilted-plane.angle_deg={}", angle_deg),
                "--set", "lookup.filter=" + filter,
                "--set", fmt::format("bias.constant_m={}", bias_m)};
    }
};

double texel_m(int angle_deg)
{
    static std::map<int, double> known;
    if (const auto found = known.find(angle_deg); found != known.end()) {
        return found->second;
    }
    const Ending ending =
        gnomon({"compare", "--builtin", "tilted-plane", "--set", "image.width=16", "--set",
                "image.height=9", "--set", "shadow_map.resolution=512", "--set",
                fmt::format("scene.tilted-plane.angle_deg={}", angle_deg), "--json"});
    return known[angle_deg] = GateJson::parse(ending.out).at("frustum").at("texel_m").get<double>();
}

/// Runs the gate over a change of bias; it must not change a count.
/// @return  "EXIT_CODE shadow_amount" if the amount became worse, else "pass".
std::string judged(const Tilt& before, double texels_before, const Tilt& after, double texels_after)
{
    GateFolder folder;
    folder.builtin = "tilted-plane";
    const double width_m = texel_m(before.angle_deg);
    folder.compare("before", before.settings(width_m, texels_before));
    folder.compare("after", after.settings(width_m, texels_after));
    expect_done(folder.save("before"));
    const Ending ending = folder.gate("after", {"--json"});
    const GateJson found = GateJson::parse(ending.out);
    std::set<std::string> metrics;
    for (const GateJson& finding : found.at("findings")) {
        EXPECT_NE(finding.at("metric"), "false_shadow") << finding;
        metrics.insert(finding.at("metric").get<std::string>());
    }
    EXPECT_EQ(ending.exit_code == 0, found.at("result") == "pass") << ending.err;
    return found.at("result") == "pass"
               ? "pass"
               : fmt::format("{} {}", ending.exit_code,
                             metrics.contains("shadow_amount") ? "shadow_amount"
                                                               : fmt::format("{}", metrics));
}

const std::vector<Tilt> kernels{{0, "pcf3", 3}, {0, "pcf5", 5}, {0, "pcf7", 7}, {0, "pcf9", 9}};

/// Self-shadowing ends at a bias of half the kernel's width, but the count of wrong pixels at half
/// a texel's. Just above that the count is 0, though nearly half of every pixel is shadowed.
void expect_biases_found(int angle_deg)
{
    for (Tilt tilt : kernels) {
        tilt.angle_deg = angle_deg;
        const double enough = 0.51 * tilt.width;
        for (const double too_little : {0.55, 0.4 * tilt.width}) {
            EXPECT_EQ(judged(tilt, enough, tilt, too_little), "1 shadow_amount")
                << tilt.filter << " at " << angle_deg << " degrees, " << too_little;
        }
    }
}

void expect_kernels_judged(int angle_deg)
{
    for (std::size_t i = 1; i < kernels.size(); ++i) {
        Tilt small = kernels[0];
        Tilt large = kernels[i];
        small.angle_deg = large.angle_deg = angle_deg;
        EXPECT_EQ(judged(small, 1.55, large, 1.55), "1 shadow_amount") << large.filter;
        EXPECT_EQ(judged(large, 1.55, small, 1.55), "pass") << large.filter;
        EXPECT_EQ(judged(large, 0.6, large, 0.51 * large.width), "pass") << large.filter;
    }
}

TEST(GateAmounts, FindsABiasThatOnlyAmountsShow)
{
    Tilt tilt = kernels[1];
    tilt.angle_deg = 45;
    EXPECT_EQ(judged(tilt, 2.55, tilt, 0.55), "1 shadow_amount");
    EXPECT_EQ(judged(tilt, 0.55, tilt, 2.55), "pass");
}

TEST(LongGateAmounts, FindsBiasesThatOnlyAmountsShow)
{
    for (const int angle_deg : {25, 45, 60, 70}) {
        expect_biases_found(angle_deg);
    }
}

TEST(LongGateAmounts, FindsKernelsThatGrewAndPassesWhatBecameBetter)
{
    for (const int angle_deg : {30, 55}) {
        expect_kernels_judged(angle_deg);
    }
}

TEST(GateAmounts, FailsWhereNothingIsTested)
{
    GateFolder folder;
    const auto size = tests::in_lane<std::vector<std::string>>(
        {"--set", "image.width=64", "--set", "image.height=36"}, {});
    folder.compare("before", size);
    folder.compare("narrow", with(size, {"--set", "light.cone_deg=0.01"}));
    folder.compare("sky", with(size, {"--set", "camera.eye=[0, 5, 0]", "--set",
                                      "camera.target=[0.1, 50, 0]"}));
    expect_done(folder.save("before"));
    for (const std::string run : {"narrow", "sky"}) {
        const Ending ending = folder.gate(run);
        EXPECT_EQ(ending.exit_code, 1) << run << ending.err;
        EXPECT_THAT(ending.out, HasSubstr("nothing is tested: at least")) << run;
        const GateJson found = GateJson::parse(folder.gate(run, {"--json"}).out);
        EXPECT_EQ(found.at("findings").at(0).at("reason"), "nothing_tested") << run;
        if (!tests::runs_full_tests() && run == "narrow") {
            continue; // the usual lane tries the rules with one of them
        }
        // Rules about other metrics do not hide it.
        folder.write("gate.toml", "[[rule]]\nid = \"few\"\nmetric = \"false_lit\"\nmax = 1e9\n");
        EXPECT_EQ(folder.gate(run, {"--rules", folder.at("gate.toml")}).exit_code, 1) << run;
    }
    // A rule that sets a minimum does.
    folder.write("gate.toml", "[[rule]]\nid = \"few\"\nmetric = \"scored_pixels\"\nmin = 0\n");
    EXPECT_EQ(folder.gate("narrow", {"--rules", folder.at("gate.toml")}).exit_code, 0);
}

TEST(GateEndings, FailWithFourWhereTheRunIsDamaged)
{
    GateFolder folder;
    folder.compare("run", {});
    expect_done(folder.save("run"));
    std::filesystem::resize_file(folder.at("run/results.sqlite"), 8192);
    const Ending ending = folder.gate("run");
    EXPECT_EQ(ending.exit_code, 4);
    EXPECT_THAT(ending.err, HasSubstr("results.sqlite: is damaged"));
}

TEST(GateEndings, WriteJunitWhereThereIsNoBaseline)
{
    GateFolder folder;
    folder.compare("run", {});
    const Ending ending = folder.gate("run", {"--junit", folder.at("gate.xml")});
    EXPECT_EQ(ending.exit_code, 3);
    const std::string xml = text_of(folder.at("gate.xml"));
    EXPECT_THAT(xml, HasSubstr("errors=\"1\""));
    EXPECT_THAT(xml, HasSubstr("type=\"not_comparable\""));
}

} // namespace
} // namespace gnomon::testing
