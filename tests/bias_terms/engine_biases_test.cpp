#include "analysis/bias/bias_verification.hpp"
#include "analysis/lookup/amounts.hpp"
#include "closed_form.hpp"
#include "compared.hpp"
#include "gl_case.hpp"
#include "lane.hpp"
#include "methods_job.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/pixels/map_texels.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

/// The engines' bias terms, each against a closed form.
namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Comparison;
using scene::PixelClass;
using Settings = std::vector<scene::Override>;

Settings joined(Settings keys, const Settings& more)
{
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

scene::Job small_job(const char* builtin, const Settings& keys)
{
    const Settings size{{"image.width", "160"},
                        {"image.height", "90"},
                        {"shadow_map.resolution", "128"},
                        {"bias.constant", "0"}};
    return tests::builtin_job(builtin, joined(size, keys)).job;
}

/// A plane under a map whose texel grid is rotated against it.
scene::Job plane(int angle_deg, const Settings& keys)
{
    const Settings askew{{"scene.tilted-plane.angle_deg", fmt::format("{}", angle_deg)},
                         {"shadow_map.roll_deg", "30"},
                         {"shadow_map.depth_format", "d32f"}};
    return small_job("tilted-plane", joined(askew, keys));
}

void expect_equal_verdicts(const Comparison& a, const Comparison& b)
{
    std::size_t receivers = 0;
    for (std::size_t i = 0; i < a.lookup.samples.pixel_count(); ++i) {
        if (a.receivers.triangle[i] != scene::no_triangle) {
            ++receivers;
            ASSERT_EQ(a.lookup.samples[i].verdict, b.lookup.samples[i].verdict) << "pixel " << i;
        }
    }
    EXPECT_GT(receivers, 1000U);
}

/// GL's lookups with other constant biases agree with the curve.
void expect_exact_curve(const Compared& compared, const scene::Job& job)
{
    const Comparison comparison = compared(job);
    ASSERT_TRUE(comparison.diagnosis);
    ASSERT_TRUE(comparison.diagnosis->biases);
    const auto verification = analysis::verify_comparison(comparison, compared.renderers());
    ASSERT_TRUE(verification);
    for (const auto& rerun : verification->reruns) {
        EXPECT_EQ(rerun.differences, 0U) << "bias " << rerun.bias;
    }
    std::uint64_t explained = 0;
    for (const Cause cause :
         {Cause::bias, Cause::precision, Cause::filter, Cause::resolution, Cause::coverage}) {
        explained += comparison.diagnosis->causes.counts.of(cause);
    }
    EXPECT_EQ(explained, comparison.metrics.false_shadow + comparison.metrics.false_lit);
}

/// Settings that each activate one term.
const std::vector<Settings>& terms()
{
    static const std::vector<Settings> all{
        {{"bias.normal_m", "0.02"}},
        {{"bias.constant_texels", "0.5"}},
        {{"bias.polygon_offset_factor", "0.7"}, {"bias.polygon_offset_units", "4"}},
        {{"bias.slope_kernels", "0.8"}},
        {{"bias.adaptive_m", "0.001"}},
        {{"bias.receiver_plane", "analytic"}, {"bias.receiver_plane_clamp", "0.01"}},
        {{"bias.receiver_plane", "derivatives"}}};
    return all;
}

TEST(EngineBiases, LeaveCurvesAndCausesExact)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{small_job("wall", {})};
    std::size_t number = 0;
    for (const char* const filter : {"nearest", "hardware", "pcf3"}) {
        for (const Settings& term : terms()) {
            if (!runs_full_tests() && number++ % 3 != 0) {
                continue; // the usual lane tries each term with one filter
            }
            SCOPED_TRACE(fmt::format("{} {}", filter, term.front().key));
            expect_exact_curve(compared,
                               small_job("wall", joined({{"lookup.filter", filter}}, term)));
        }
    }
}

TEST(EngineBiases, FollowAReversedMap)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{small_job("wall", {})};
    for (const Settings& term : terms()) {
        if (term.front().key == "bias.polygon_offset_factor") {
            continue; // is added to the depth whichever way it runs
        }
        SCOPED_TRACE(term.front().key);
        const Settings set =
            joined(term, {{"shadow_map.depth_format", "d32f"}, {"bias.constant", "1e-5"}});
        const Comparison plain = compared.without_diagnosis(small_job("wall", set));
        const Comparison reversed = compared.without_diagnosis(
            small_job("wall", joined(set, {{"shadow_map.reversed", "true"}})));
        // Depths round differently, so a few pixels change sides.
        EXPECT_NEAR(static_cast<double>(reversed.metrics.false_shadow),
                    static_cast<double>(plain.metrics.false_shadow), 30);
        EXPECT_NEAR(static_cast<double>(reversed.metrics.false_lit),
                    static_cast<double>(plain.metrics.false_lit), 30);
    }
}

// Both round the same length to float32 once.
TEST(NormalLength, IsANormalOffsetOfTheTexelsThatItIsLong)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{small_job("wall", {})};
    const Comparison texels =
        compared.without_diagnosis(small_job("wall", {{"bias.normal_texels", "2"}}));
    const double length_m = 2 * texels.view.first_map().texel_width_m(1, 128);
    const Comparison metres = compared.without_diagnosis(
        small_job("wall", {{"bias.normal_m", fmt::format("{:.17g}", length_m)}}));
    expect_equal_verdicts(texels, metres);
}

TEST(TexelBias, IsAConstantBiasOfADirectionalLight)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{small_job("wall", {})};
    const Comparison texels =
        compared.without_diagnosis(small_job("wall", {{"bias.constant_texels", "0.75"}}));
    const scene::LightFrustum& map = texels.view.first_map();
    const double depth = 0.75 * map.texel_width_m(1, 128) / map.range_m();
    const Comparison constant = compared.without_diagnosis(
        small_job("wall", {{"bias.constant", fmt::format("{:.17g}", depth)}}));
    expect_equal_verdicts(texels, constant);
}

// ζ' = ζ − k ζ is the light distance of the moved point. r and the bias round a few times to 2^-24.
TEST(TexelBias, MovesAReceiverOfASpotByATexelThere)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{small_job("sphere-plane", {})};
    const Comparison plain = compared.without_diagnosis(small_job("sphere-plane", {}));
    const Comparison moved =
        compared.without_diagnosis(small_job("sphere-plane", {{"bias.constant_texels", "1"}}));
    const scene::LightFrustum& map = plain.view.first_map();
    ASSERT_EQ(map.projection, scene::Projection::perspective);
    const double k = map.texel_width_m(1, 128);
    const double a = 1 / map.near_m - 1 / map.far_m;
    for (std::size_t i = 0; i < plain.lookup.samples.pixel_count(); ++i) {
        const double r = plain.lookup.samples[i].receiver_depth;
        if (plain.receivers.triangle[i] == scene::no_triangle || r <= 0 || r >= 1) {
            continue;
        }
        const double distance_m = 1 / (1 / map.near_m - a * r);
        const double expected = (1 / map.near_m - 1 / (distance_m * (1 - k))) / a;
        ASSERT_NEAR(moved.lookup.samples[i].receiver_depth, expected, 16 * 0x1p-24);
    }
}

// GL may use the root of both squares instead of the larger change; llvmpipe uses the larger. Each
// depth rounds to 2^-24 in either map, and the driver's plane errs by a few of those.
TEST(PolygonOffset, MovesWhatIsDrawnByItsSlope)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job = plane(60, {});
    const Compared compared{job};
    const Comparison plain = compared.without_diagnosis(job);
    const scene::Image<float> before = compared.drawn(job, plain.view).map->map().depths();
    const scene::Job offset_job = plane(60, {{"bias.polygon_offset_factor", "2"}});
    const Comparison offset = compared.without_diagnosis(offset_job);
    const scene::Image<float> after = compared.drawn(offset_job, offset.view).map->map().depths();
    const PlaneDepth depth{plain};
    const double per_u = std::abs(depth(1, 0) - depth(0, 0));
    const double per_v = std::abs(depth(0, 1) - depth(0, 0));
    const double least = 2 * std::max(per_u, per_v) - 64 * 0x1p-24;
    const double most = 2 * std::hypot(per_u, per_v) + 64 * 0x1p-24;
    std::size_t moved = 0;
    for (std::size_t i = 0; i < before.pixel_count(); ++i) {
        if (before[i] < 1 && after[i] < 1) {
            ++moved;
            ASSERT_GE(double{after[i]} - double{before[i]}, least) << "texel " << i;
            ASSERT_LE(double{after[i]} - double{before[i]}, most) << "texel " << i;
        }
    }
    EXPECT_GT(moved, 1000U);
}

TEST(PolygonOffset, IsLimitedByItsClamp)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job = plane(60, {});
    const Compared compared{job};
    const Comparison comparison = compared.without_diagnosis(job);
    const scene::Image<float> before = compared.drawn(job, comparison.view).map->map().depths();
    const scene::Job clamped = plane(
        60, {{"bias.polygon_offset_factor", "1000"}, {"bias.polygon_offset_clamp", "0.0078125"}});
    const scene::Image<float> after =
        compared.drawn(clamped, compared.without_diagnosis(clamped).view).map->map().depths();
    for (std::size_t i = 0; i < before.pixel_count(); ++i) {
        if (before[i] < 1 && after[i] < 1) {
            ASSERT_NEAR(double{after[i]} - double{before[i]}, 0x1p-7, 64 * 0x1p-24);
        }
    }
}

// Evenly spaced depths have one r, and a plane has one slope. Each depth rounds to 2^-24, and the
// driver's plane errs by a few of those. r was measured to a relative 2^-9: 4096 units err by 8.
TEST(PolygonOffset, IsAsLongAsItMovesWhatIsDrawn)
{
    GNOMON_REQUIRE_GL();
    const Settings d24{{"shadow_map.depth_format", "d24"}};
    const scene::Job job = plane(60, d24);
    const scene::Job offset_job = plane(60, joined(d24, {{"bias.polygon_offset_factor", "2"},
                                                         {"bias.polygon_offset_units", "4096"}}));
    const Compared compared{job};
    const Comparison plain = compared.without_diagnosis(job);
    EXPECT_FALSE(plain.drawn_offset);
    const scene::Image<float> before = compared.drawn(job, plain.view).map->map().depths();
    const Comparison offset = compared.without_diagnosis(offset_job);
    ASSERT_TRUE(offset.drawn_offset);
    const scene::Image<float> after = compared.drawn(offset_job, offset.view).map->map().depths();
    const double whole{offset.drawn_offset->whole.depth.median};
    const double of_factor{offset.drawn_offset->of_factor.depth.median};
    const double least = whole - 72 * 0x1p-24;
    const double most = whole + (std::numbers::sqrt2 - 1) * of_factor + 72 * 0x1p-24;
    std::size_t moved = 0;
    for (std::size_t i = 0; i < before.pixel_count(); ++i) {
        if (before[i] < 1 && after[i] < 1) {
            ++moved;
            ASSERT_GE(double{after[i]} - double{before[i]}, least) << "texel " << i;
            ASSERT_LE(double{after[i]} - double{before[i]}, most) << "texel " << i;
        }
    }
    EXPECT_GT(moved, 1000U);
    EXPECT_GT(whole, of_factor + 4000 * 0x1p-24);
}

// A flat caster has no slope, so the offset is units · r, constant in a 24-bit map.
TEST(PolygonOffset, IsTheCauseOfTheLightThatItLetsIn)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{small_job("wall", {})};
    for (const char* const filter : {"nearest", "hardware", "pcf3"}) {
        const Comparison comparison = compared(small_job(
            "wall", {{"lookup.filter", filter}, {"bias.polygon_offset_units", "800000"}}));
        EXPECT_GT(comparison.diagnosis->causes.counts.of(Cause::bias), 50U) << filter;
    }
}

TEST(PolygonOffset, IsRefusedWhereGlOffsetsNothing)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{small_job("wall", {})};
    const Settings offset{{"bias.polygon_offset_units", "4"}};
    EXPECT_THROW((void)compared.without_diagnosis(
                     small_job("wall", joined(offset, {{"shadow_map.depth_format", "u16"}}))),
                 scene::InputError);
    EXPECT_THROW(
        (void)compared.without_diagnosis(small_job("wall", {{"bias.polygon_offset_clamp", "0.1"}})),
        scene::InputError);
    const Compared spot{small_job("sphere-plane", {})};
    EXPECT_THROW((void)spot.without_diagnosis(small_job(
                     "sphere-plane", joined(offset, {{"shadow_map.content", "distance"}}))),
                 scene::InputError);
}

class SteepPlane : public testing::TestWithParam<int> {};

// The plane's depth at a texel's centre equals the map's, up to the roundings of r, uv ·
// resolution, g · t and the driver's depth: 4 steps of 2^-24. Differences between neighbouring
// pixels round beside lengths of a few texels: 16.
TEST_P(SteepPlane, HasNoAcneWhereEachTapIsComparedWithIt)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{plane(GetParam(), {})};
    for (const char* const filter : {"nearest", "pcf3", "pcf7", "bilinear5", "hardware"}) {
        const auto false_shadow = [&](const char* how, double steps) {
            const Settings keys{{"lookup.filter", filter},
                                {"bias.receiver_plane", how},
                                {"bias.constant", fmt::format("{}", steps * 0x1p-24)}};
            return compared.without_diagnosis(plane(GetParam(), keys)).metrics.false_shadow;
        };
        EXPECT_EQ(false_shadow("analytic", 4), 0U) << filter;
        EXPECT_EQ(false_shadow("derivatives", 16), 0U) << filter;
        EXPECT_GT(false_shadow("off", 16), 100U) << filter;
    }
}

TEST_P(SteepPlane, HasNoAcneWithAnAdaptiveBias)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{plane(GetParam(), {})};
    const Comparison comparison =
        compared.without_diagnosis(plane(GetParam(), {{"bias.adaptive_m", "0.0001"}}));
    EXPECT_EQ(comparison.metrics.false_shadow, 0U);
}

TEST_P(SteepPlane, HasNoAcneWithASlopeOfAWholeKernel)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{plane(GetParam(), {})};
    for (const char* const filter : {"nearest", "pcf3", "pcf7", "hardware"}) {
        const Settings keys{{"lookup.filter", filter}, {"bias.constant", "4e-6"}};
        EXPECT_EQ(
            compared
                .without_diagnosis(plane(GetParam(), joined(keys, {{"bias.slope_kernels", "1"}})))
                .metrics.amounts.shadow,
            0)
            << filter;
    }
}

INSTANTIATE_TEST_SUITE_P(Angles, SteepPlane, testing::Values(20, 60, 80));

/// The largest depth by which a lit receiver lies behind the nearest of the four texels that GL
/// compares at once, in units of its plane's rise per texel.
double largest_need_of_gathers(const Comparison& comparison, const scene::Image<float>& map)
{
    const double per_texel = PlaneDepth{comparison}.per_texel();
    const scene::LookupLayers& lookup = comparison.lookup;
    const int last = map.size().width_px - 1;
    double largest = 0;
    for (std::size_t i = 0; i < lookup.samples.pixel_count(); ++i) {
        const scene::Vec2f texel = lookup.texels[i] - 0.5F;
        const auto x = static_cast<int>(std::floor(texel.x));
        const auto y = static_cast<int>(std::floor(texel.y));
        const bool is_inside = x >= 0 && y >= 0 && x < last && y < last;
        if (comparison.truth.pixel_class[i] != PixelClass::lit || !is_inside) {
            continue;
        }
        float nearest = 1;
        for (const scene::Texel tap :
             {scene::Texel{x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}}) {
            nearest = std::min(nearest, scene::at_texel(map, tap));
        }
        const double need = double{lookup.samples[i].receiver_depth} - double{nearest};
        largest = std::max(largest, need / per_texel);
    }
    return largest;
}

// Without the fractional term the plane is evaluated only at the lookup point, t = 0: one reference
// for four texels, the farthest up to a texel away along each axis. A constant of |g_u| + |g_v|
// suffices, and the term is twice that. Roundings as above: 16 steps.
TEST_P(SteepPlane, NeedsTheFractionalTermWhereGlComparesFourTexelsAtOnce)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{plane(GetParam(), {})};
    const auto hardware = [&](double bias, const char* how) {
        return compared.without_diagnosis(
            plane(GetParam(), {{"lookup.filter", "hardware"},
                               {"bias.constant", fmt::format("{:.17g}", bias)},
                               {"bias.receiver_plane", how}}));
    };
    const double roundings = 16 * 0x1p-24;
    const Comparison without = hardware(roundings, "off");
    EXPECT_GT(without.metrics.false_shadow, 1000U);
    EXPECT_EQ(hardware(roundings, "analytic").metrics.amounts.shadow, 0);
    const double per_texel = PlaneDepth{without}.per_texel();
    EXPECT_EQ(hardware(per_texel + roundings, "off").metrics.amounts.shadow, 0);
    EXPECT_GT(hardware(0.75 * per_texel, "off").metrics.amounts.shadow, 0);
    const double need = largest_need_of_gathers(
        without, compared.drawn(without.job, without.view).map->map().depths());
    EXPECT_LE(need, 1 + roundings / per_texel);
    EXPECT_GT(need, 0.9);
    RecordProperty("false_shadow_without_the_term",
                   fmt::format("{}", without.metrics.false_shadow));
    RecordProperty("largest_need", fmt::format("{:.4f}", need));
}

// Dou et al. move the depth to the centre of the receiver's texel. All taps of a kernel are
// compared with that depth, so the farther ones shadow the plane.
TEST_P(SteepPlane, KeepsAcneOfAKernelsOtherTapsWithAnAdaptiveBias)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{plane(GetParam(), {})};
    const auto shadow = [&](const char* filter, const Settings& bias) {
        const Settings keys{{"lookup.filter", filter}, {"bias.constant", "1e-6"}};
        return compared.without_diagnosis(plane(GetParam(), joined(keys, bias)))
            .metrics.amounts.shadow;
    };
    const Settings adaptive{{"bias.adaptive_m", "0.0001"}};
    EXPECT_EQ(shadow("nearest", adaptive), 0);
    EXPECT_GT(shadow("pcf5", adaptive), 1000);
    EXPECT_EQ(shadow("pcf5", {{"bias.receiver_plane", "analytic"}}), 0);
    RecordProperty("shadow_amount_of_pcf5", fmt::format("{:.1f}", shadow("pcf5", adaptive)));
}

TEST(ReceiverPlane, LeavesAcneWhereItsClampIsLessThanThePlaneNeeds)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{plane(60, {})};
    const double per_texel = PlaneDepth{compared.without_diagnosis(plane(60, {}))}.per_texel();
    const auto false_shadow = [&](double limit) {
        return compared
            .without_diagnosis(plane(60, {{"lookup.filter", "pcf3"},
                                          {"bias.receiver_plane", "analytic"},
                                          {"bias.constant", "4e-6"},
                                          {"bias.receiver_plane_clamp", fmt::format("{}", limit)}}))
            .metrics.false_shadow;
    };
    EXPECT_EQ(false_shadow(2.01 * per_texel), 0U);
    EXPECT_GT(false_shadow(0.5 * per_texel), 100U);
}

TEST(ReceiverPlane, IsRefusedWhereNoTapHasADepthOfItsOwn)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{small_job("wall", {})};
    const Settings on{{"bias.receiver_plane", "analytic"}};
    EXPECT_THROW((void)compared.without_diagnosis(
                     small_job("wall", joined(on, {{"lookup.filter", "linear"}}))),
                 scene::InputError);
    EXPECT_THROW(
        (void)compared.without_diagnosis(small_job("wall", joined(on, {{"method.name", "vsm"}}))),
        scene::InputError);
}

} // namespace
} // namespace gnomon::tests
