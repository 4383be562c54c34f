#include "closed_form.hpp"
#include "compared.hpp"
#include "lane.hpp"

namespace gnomon::tests {
namespace {

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
                // Sampling at pixels and the code's rounding shift "half" by a few percent.
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
