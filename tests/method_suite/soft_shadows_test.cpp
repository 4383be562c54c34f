// Percentage-closer soft shadows against closed forms.

#include "compared.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tests {
namespace {

const std::vector<scene::Override> soft{
    {"method.name", "pcss"},          {"shadow_map.depth_format", "d32f"},
    {"shadow_map.resolution", "128"}, {"lookup.outside", "clamp"},
    {"bias.constant", "0"},           {"bias.slope", "0"},
    {"bias.normal_texels", "0"}};

/// A plate's shadow border softens to either side by its height times the tangent of the light's
/// angle.
TEST(SoftShadows, AreAsWideAsTheLightIsSeenFromThePlatesBorder)
{
    GNOMON_REQUIRE_GL();
    constexpr double texel_m = 0.125;
    constexpr double edge_m = 2;
    for (const double height_m : {0.75, 1.5, 2.0}) {
        const double angle_deg = 20;
        const double radius_m = height_m * std::tan(angle_deg * std::numbers::pi / 180);
        MethodCase c{
            looking_down(job_of_builtin(
                "wall", with(soft, {{"method.taps", "81"},
                                    {"method.search_radius_texels", "8"},
                                    {"method.biased_search", "false"},
                                    {"method.light_angle_deg", std::to_string(angle_deg)}}))),
            plates_over_ground({{-edge_m, edge_m, -3, 3, height_m}})};
        c.draw_map();
        const auto lookup = c.look_up(0x1p-10F);
        const int row = lookup.samples.size().height_px / 2;
        const int width = lookup.samples.size().width_px;
        std::size_t between = 0;
        for (int x = width / 2; x < width; ++x) {
            const float verdict = lookup.samples(x, row).verdict;
            const double beyond_m = (x + 0.5 - width / 2.0) * 8 / width - edge_m;
            if (std::abs(beyond_m) > radius_m + texel_m) {
                ASSERT_EQ(verdict, beyond_m > 0 ? 1 : 0) << height_m << " m: " << beyond_m;
                continue;
            }
            // Nine columns of taps, and the map knows the border and each tap to half a texel.
            const double share = std::clamp((1 + beyond_m / radius_m) / 2, 0.0, 1.0);
            ASSERT_NEAR(verdict, share, 1 / 9.0 + texel_m / (2 * radius_m))
                << height_m << " m: " << beyond_m;
            between += verdict > 0 && verdict < 1 ? 1U : 0U;
        }
        // A pixel is half a texel wide.
        EXPECT_GT(static_cast<double>(between), 2 * (2 * radius_m / texel_m) * 0.7) << height_m;
    }
}

TEST(SoftShadows, OfALightWithoutExtentAreThoseOfTheNearestTexel)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin : {"sphere-plane", "yard", "lamp-room"}) {
        std::vector<scene::Override> keys = with(soft, {{"method.light_radius_m", "0"},
                                                        {"method.light_angle_deg", "0"},
                                                        {"image.width", "240"},
                                                        {"image.height", "135"},
                                                        {"bias.constant", "0.002"}});
        MethodCase point{builtin, keys};
        std::erase_if(keys,
                      [](const scene::Override& key) { return key.key.starts_with("method."); });
        MethodCase nearest{builtin, with(keys, {{"lookup.filter", "nearest"}})};
        point.draw_map();
        nearest.draw_map();
        const auto found = point.look_up(0.002F).samples;
        const auto expected = nearest.look_up(0.002F).samples;
        for (std::size_t i = 0; i < found.pixel_count(); ++i) {
            ASSERT_EQ(found[i].verdict, expected[i].verdict) << builtin << " pixel " << i;
        }
    }
}

/// If a larger bias excludes a blocker, the mean of the remaining ones is nearer to the light, and
/// the kernel wider.
TEST(SoftShadows, FallWithTheBiasWhereTheSearchIsBiasedAndOnlyThere)
{
    GNOMON_REQUIRE_GL();
    for (const bool is_biased : {true, false}) {
        MethodCase c{"sphere-cube",
                     with(soft, {{"image.width", "240"},
                                 {"image.height", "135"},
                                 {"method.light_radius_m", "0.3"},
                                 {"method.light_angle_deg", "5"},
                                 {"method.biased_search", is_biased ? "true" : "false"}})};
        const methods::LookupTraits promised = methods::traits(c.job);
        EXPECT_EQ(promised.monotonicity.how,
                  is_biased ? methods::Monotone::no : methods::Monotone::exactly);
        EXPECT_EQ(promised.has_curve(), !is_biased);
        c.draw_map();
        std::size_t falls = 0;
        std::vector<float> before;
        for (int step = 0; step <= 40; ++step) {
            const auto samples = c.look_up(static_cast<float>(step) * 0x1p-11F).samples;
            for (std::size_t i = 0; i < before.size(); ++i) {
                falls += samples[i].verdict < before[i] ? 1U : 0U;
            }
            before.clear();
            for (const auto& sample : samples) {
                before.push_back(sample.verdict);
            }
        }
        if (is_biased) {
            EXPECT_GT(falls, 10U);
        } else {
            EXPECT_EQ(falls, 0U);
        }
    }
}

TEST(SoftShadows, RefuseInOneLineWhatTheyCannotFilter)
{
    const auto refusal = [](const std::vector<scene::Override>& keys) -> std::string {
        try {
            methods::check(job_of_builtin("yard", with(soft, keys)));
        } catch (const scene::InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal({}), "");
    EXPECT_EQ(refusal({{"shadow_map.layout", "cascades"}, {"shadow_map.cascades", "2"}}),
              "method.name = \"pcss\": its search radius would differ between cascades; use "
              "shadow_map.layout = \"single\", or the method \"pcf\"");
    EXPECT_EQ(refusal({{"method.taps", "30"}}),
              "method.taps = 30: a grid has an odd number of taps along each side; use 9, 25, 49 "
              "or 81, or another method.pattern");
}

} // namespace
} // namespace gnomon::tests
