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

/// The most that nearest codes lie below the plane's depth, over the texels that lit pixels look
/// up: half a code where depths of neighbouring texels fall evenly between codes, but less where
/// they repeat after a few texels.
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
    // Few pixels meet a texel's corner and the largest rounding at the same time.
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
    // A point at the share u between two texels' centres is shadowed by the nearer to the light as
    // long as the bias is below u times a texel's slope, with the weight 1 − u: more than one half
    // where u is below one half.
    const double half = half_texel_slope(setting, result.view.first_map());
    // Few pixels lie at the very end of their texel: 2 %, as above.
    EXPECT_NEAR(double{strict.acne_free}, 2 * half, 0.02 * 2 * half);
    EXPECT_NEAR(double{strict.acne_free_count}, half, 0.02 * half);
    // The amount of acne at bias 0 is ∫ (1 − u) du: one half of the pixels. An allowance of 1 %
    // leaves the last of it, (1 − b/2h)² / 2 = 0.01.
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

} // namespace
} // namespace gnomon::tests
