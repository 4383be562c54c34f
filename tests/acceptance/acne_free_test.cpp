#include "closed_form.hpp"
#include "compared.hpp"
#include "lane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

/// The smallest acne-free bias of a plane has a closed form.
namespace gnomon::tests {
namespace {

/// The most that a stored code lies below the plane's depth, over the texels that lit pixels read.
/// It is half a code if depths fall evenly between codes, and less if they repeat after a few
/// texels.
double largest_rounding(const analysis::Comparison& result)
{
    const scene::DepthFormat format = result.job.shadow_map.depth_format;
    if (format.is_float()) {
        return 0x1p-25;
    }
    const double codes = std::ldexp(1.0, format.bits) - 1;
    const PlaneDepth depth{result};
    double largest = 0;
    for (std::size_t i = 0; i < result.truth.pixel_class.pixel_count(); ++i) {
        if (result.truth.pixel_class[i] == scene::PixelClass::lit) {
            const scene::Vec2f texel = result.lookup.texels[i];
            const double code =
                codes * depth(std::floor(double{texel.x}) + 0.5, std::floor(double{texel.y}) + 0.5);
            largest = std::max(largest, (code - std::round(code)) / codes);
        }
    }
    return largest;
}

void expect_closed_form(const Compared& compared, const TiltedPlaneSetting& setting)
{
    const auto result = compared(tilted_plane_job(setting, 0));
    ASSERT_GE(result.metrics.pixels.of(scene::PixelClass::lit), 500000U) << text(setting);
    // r and d are rounded a few times each.
    const double expected =
        half_texel_slope(setting, result.view.first_map()) + largest_rounding(result) + 4 * 0x1p-24;
    const double found = double{result.diagnosis->biases->bounds.strict.acne_free};
    // Few pixels have both a texel's corner and the largest rounding.
    EXPECT_NEAR(found, expected, 0.02 * expected) << text(setting);
}

TEST(AcneFreeBias, EqualsHalfATexelsSlopePlusTheFormatsRounding)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{tilted_plane_job({45, 512, "d32f", 0}, 0)};
    expect_closed_form(compared, {45, 512, "d32f", 0});
    expect_closed_form(compared, {45, 1024, "d16", 45});
    if (runs_full_tests()) {
        expect_closed_form(compared, {45, 512, "d32f", 45});
        expect_closed_form(compared, {45, 1024, "d16", 0});
    }
}

TEST(AcneFreeBias, OfHardwareIsATexelsSlopeTapByTapAndHalfOfItByCount)
{
    GNOMON_REQUIRE_GL();
    const TiltedPlaneSetting setting{45, 512, "d32f", 0};
    scene::Job job = tilted_plane_job(setting, 0);
    job.lookup.filter = scene::Filter::hardware;
    if (!runs_full_tests()) {
        job.image = {640, 360};
    }
    const Compared compared{job};
    const auto result = compared(job);
    const analysis::BiasLimits& strict = result.diagnosis->biases->bounds.strict;
    // At the share u between two texels' centres, the texel nearer to the light has the weight 1 −
    // u. It shadows the point while the bias is below u times a texel's slope.
    const double half = half_texel_slope(setting, result.view.first_map());
    // Few pixels lie at the end of their texel: 2 %, as above.
    EXPECT_NEAR(double{strict.acne_free}, 2 * half, 0.02 * 2 * half);
    EXPECT_NEAR(double{strict.acne_free_count}, half, 0.02 * half);
    // The amount of acne at bias 0 is ∫ (1 − u) du, half of the pixels. An allowance of 1 % is
    // reached at (1 − b/2h)² / 2 = 0.01.
    const analysis::BiasLimits& hundredth = result.diagnosis->biases->bounds.allowances[2];
    EXPECT_NEAR(double{hundredth.acne_free}, 2 * half * (1 - std::sqrt(0.02)), 0.02 * 2 * half);
}

TEST(LongAcneFreeBias, EqualsTheClosedFormForAnglesResolutionsAndFormats)
{
    GNOMON_REQUIRE_GL();
    for (const int angle_deg : {15, 30, 45, 60, 75}) {
        const Compared compared{tilted_plane_job({angle_deg, 512, "d32f", 0}, 0)};
        for (const int resolution : {512, 1024, 2048, 4096}) {
            for (const char* format : {"d16", "d24", "d32f", "u12"}) {
                for (const double roll_deg : {0.0, 45.0}) {
                    expect_closed_form(compared, {angle_deg, resolution, format, roll_deg});
                }
            }
        }
    }
}

class TiltedPlane : public testing::TestWithParam<int> {};

TEST_P(TiltedPlane, IsHalfAcneWithoutBiasAndNoneJustAboveTheClosedForm)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{tilted_plane_job({GetParam(), 512, "d32f", 0}, 0)};
    int number = 0;
    for (const int resolution : {512, 2048}) {
        for (const char* format : {"d16", "d24", "d32f"}) {
            ++number;
            for (const double roll_deg : {0.0, 30.0, 45.0}) {
                if (!runs_full_tests() && number++ % 3 != 0) {
                    continue; // the usual lane tries each format and roll at each resolution
                }
                const TiltedPlaneSetting s{GetParam(), resolution, format, roll_deg};
                const auto label = text(s);
                const auto without = compared.without_diagnosis(tilted_plane_job(s, 0));
                EXPECT_GE(without.metrics.pixels.of(scene::PixelClass::lit), 500000U) << label;
                // Sampling at pixels and the format's rounding shift one half by a few per cent.
                EXPECT_NEAR(without.metrics.false_shadow_rate.value(), 0.5, 0.05) << label;
                const double bias = 1.02 * closed_form_bias(s, without.view.first_map());
                EXPECT_EQ(
                    compared.without_diagnosis(tilted_plane_job(s, bias)).metrics.false_shadow, 0U)
                    << label;
                const double too_small = 0.9 * closed_form_bias(s, without.view.first_map());
                EXPECT_GT(
                    compared.without_diagnosis(tilted_plane_job(s, too_small)).metrics.false_shadow,
                    0U)
                    << label;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Angles, TiltedPlane, testing::Values(20, 45, 70));

} // namespace
} // namespace gnomon::tests
