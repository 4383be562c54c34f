// A filter's amounts of error on a plane follow from geometry.

#include "child_process.hpp"
#include "lane.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

Ending compare_plane(int angle_deg, const std::string& filter, double bias_m,
                     const std::vector<std::string>& more)
{
    return gnomon(with({"compare", "--builtin", "tilted-plane", "--set",
                        fmt::format("scene.tilted-plane.angle_deg={}", angle_deg), "--set",
                        "shadow_map.resolution=512", "--set", "image.width=320", "--set",
                        "image.height=180", "--set", "lookup.filter=" + filter, "--set",
                        fmt::format("bias.constant_m={}", bias_m)},
                       more));
}

/// Taps of a K×K kernel are spread evenly within K/2 texels of the receiver. With a bias of b
/// metres, those beyond b/(w tan θ) texels shadow it: a share of 1/2 − b/(K w tan θ).
TEST(Amounts, OfATiltedPlaneAreTheShareOfTapsThatItsSlopeShadows)
{
    for (const int angle_deg : {25, 60}) {
        const json plain = json::parse(compare_plane(angle_deg, "pcf3", 0, {"--json"}).out);
        const double step_m = plain.at("frustum").at("texel_m").get<double>() *
                              std::tan(angle_deg * std::numbers::pi / 180);
        // The usual lane tries each width at one angle.
        std::vector<int> widths = angle_deg == 25 ? std::vector{3, 9} : std::vector{5};
        if (tests::runs_full_tests()) {
            widths = {3, 5, 9};
        }
        for (const int width : widths) {
            for (const double part : {0.0, 0.2, 0.45}) {
                if (!tests::runs_full_tests() && part != (width == 3   ? 0.0
                                                          : width == 9 ? 0.45
                                                                       : 0.2)) {
                    continue; // the usual lane tries each width and each bias once
                }
                const double bias_m = part * width * step_m;
                const json found = json::parse(
                    compare_plane(angle_deg, fmt::format("pcf{}", width), bias_m, {"--json"}).out);
                // The image's 180 rows sample the texels unevenly along the slope: less than one in
                // 180 / 2.
                EXPECT_NEAR(found.at("shadow_amount_rate").get<double>(), 0.5 - part, 1.0 / 90)
                    << "pcf" << width << " at " << angle_deg << " degrees, bias " << bias_m;
                EXPECT_EQ(found.at("shadow_amount_rate"), found.at("mean_abs_error"));
                EXPECT_EQ(found.at("light_amount"), 0);
            }
        }
    }
}

TEST(Amounts, AreInTheTableAndItsSentence)
{
    const Ending table =
        gnomon({"compare", "--verbose", "--builtin", "tilted-plane", "--set",
                "scene.tilted-plane.angle_deg=60", "--set", "shadow_map.resolution=512", "--set",
                "lookup.filter=pcf5", "--set", "bias.constant=0.0008", "--set", "image.width=640",
                "--set", "image.height=360"});
    EXPECT_EQ(table.exit_code, 0) << table.err;
    EXPECT_THAT(table.out, HasSubstr("mean |verdict - truth|"));
    EXPECT_THAT(table.out, HasSubstr("41.8 % of the lit surface shadows itself (acne)"));
    EXPECT_THAT(table.out, ::testing::Not(HasSubstr("scored pixels are right")));
}

TEST(Amounts, EqualTheCountsWhereVerdictsAreBinary)
{
    const json found =
        json::parse(gnomon({"compare", "--builtin", "sphere-plane", "--set", "image.width=320",
                            "--set", "image.height=180", "--json"})
                        .out);
    EXPECT_EQ(found.at("shadow_amount"), found.at("false_shadow"));
    EXPECT_EQ(found.at("light_amount"), found.at("false_lit"));
    EXPECT_EQ(found.at("mean_abs_error"), found.at("error_rate"));
    EXPECT_EQ(found.at("partial"), 0);
    EXPECT_EQ(found.at("unassigned"), 0);
}

} // namespace
} // namespace gnomon::testing
