#include "compared.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

/// The plane whose acne has a closed form: the receiver's depth varies by up to half a texel's
/// slope around the texel centre where the map was sampled.
namespace gnomon::tests {
namespace {

struct Setting {
    int angle_deg;
    int resolution;
    const char* format;
    double roll_deg;
};

scene::Job job_of(const Setting& s, double bias)
{
    return scene::builtin_job("tilted-plane",
                              {{"scene.tilted-plane.angle_deg", fmt::format("{}", s.angle_deg)},
                               {"shadow_map.resolution", fmt::format("{}", s.resolution)},
                               {"shadow_map.depth_format", s.format},
                               {"shadow_map.roll_deg", fmt::format("{}", s.roll_deg)},
                               {"bias.constant", fmt::format("{}", bias)}})
        .job;
}

/// ½(|∂d/∂u| + |∂d/∂v|) per texel, plus what the format may round up: half a code, or half an ulp
/// of a float32 below 1; plus the roundings of r and d, a few times 2^-24.
double closed_form(const Setting& s, const scene::LightFrustum& frustum)
{
    const double slope = std::tan(s.angle_deg * std::numbers::pi / 180);
    const double roll_rad = s.roll_deg * std::numbers::pi / 180;
    const double texel_m = frustum.texel_width_m(1, s.resolution);
    const double per_texel = slope * texel_m / frustum.range_m();
    const auto format = scene::depth_format_from_name(s.format).value();
    const double rounding = format.is_float() ? 0x1p-25 : 0.5 / (std::ldexp(1.0, format.bits) - 1);
    return 0.5 * per_texel * (std::abs(std::cos(roll_rad)) + std::abs(std::sin(roll_rad))) +
           rounding + 4 * 0x1p-24;
}

class TiltedPlane : public testing::TestWithParam<int> {};

TEST_P(TiltedPlane, IsHalfAcneWithoutBiasAndNoneJustAboveTheClosedForm)
{
    GNOMON_REQUIRE_GL();
    const Compared compared{job_of({GetParam(), 512, "d32f", 0}, 0)};
    for (const int resolution : {512, 2048}) {
        for (const char* format : {"d16", "d24", "d32f"}) {
            for (const double roll_deg : {0.0, 30.0, 45.0}) {
                const Setting s{GetParam(), resolution, format, roll_deg};
                const auto label = fmt::format("{} deg, {}², {}, roll {}", s.angle_deg, resolution,
                                               format, roll_deg);
                const auto without = compared(job_of(s, 0));
                EXPECT_GE(without.metrics.pixels.of(scene::PixelClass::lit), 500000U) << label;
                // Sampling at pixels and the code's rounding shift "half" by a few percent.
                EXPECT_NEAR(without.metrics.false_shadow_rate.value(), 0.5, 0.05) << label;
                const double bias = 1.02 * closed_form(s, without.view.frustum);
                EXPECT_EQ(compared(job_of(s, bias)).metrics.false_shadow, 0U) << label;
                const double too_small = 0.9 * closed_form(s, without.view.frustum);
                EXPECT_GT(compared(job_of(s, too_small)).metrics.false_shadow, 0U) << label;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Angles, TiltedPlane, testing::Values(20, 45, 70));

} // namespace
} // namespace gnomon::tests
