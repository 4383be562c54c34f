#include "closed_form.hpp"
#include "compared.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <vector>

/// The smallest acne-free bias of a plane has a closed form.
namespace gnomon::tests {
namespace {

void expect_closed_form(const Compared& compared, const TiltedPlaneSetting& setting)
{
    const auto result = compared(tilted_plane_job(setting, 0));
    ASSERT_GE(result.metrics.pixels.of(scene::PixelClass::lit), 500000U) << text(setting);
    const double expected = closed_form_bias(setting, result.view.frustum);
    const double found = double{result.diagnosis->biases->bounds.strict.acne_free};
    // The roundings of r and d exceed the form a little; few pixels meet a texel's corner and a
    // code's extreme at the same time.
    EXPECT_NEAR(found, expected, 0.02 * expected) << text(setting);
}

TEST(AcneFreeBias, EqualsHalfATexelsSlopePlusTheFormatsRounding)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{tilted_plane_job({45, 512, "d32f", 0}, 0)};
    for (const double roll_deg : {0.0, 45.0}) {
        expect_closed_form(compared, {45, 512, "d32f", roll_deg});
        expect_closed_form(compared, {45, 1024, "d16", roll_deg});
    }
}

TEST(AcneFreeBias, EqualsTheClosedFormForAnglesResolutionsAndFormats)
{
    GNOMON_REQUIRE_GL();
    if (std::getenv("GNOMON_FULL_TESTS") == nullptr) {
        GTEST_SKIP() << "long: GNOMON_FULL_TESTS is not set";
    }
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
