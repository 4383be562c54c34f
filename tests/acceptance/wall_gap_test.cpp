#include "analysis/pixels/receiver_geometry.hpp"
#include "compared.hpp"
#include "lane.hpp"
#include "methods/depth/depth_map.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

/// A bias of b metres detaches the shadow of an upright sheet on flat ground by b·sin θ. The
/// largest gap is b.
namespace gnomon::tests {
namespace {

using analysis::Label;

scene::Job wall_job(int angle_deg, double bias_m)
{
    return scene::builtin_job("wall", {{"scene.wall.light_angle_deg", fmt::format("{}", angle_deg)},
                                       {"bias.constant_m", fmt::format("{}", bias_m)},
                                       {"shadow_map.resolution", "4096"},
                                       {"shadow_map.depth_format", "d32f"}})
        .job;
}

/// The largest width of a pixel on the ground: its width across the view over the cosine between
/// the view and the ground's normal.
double footprint_on_ground_m(const analysis::ReceiverGeometry& geometry, const scene::View& view,
                             std::size_t pixel)
{
    const scene::Vec3d towards_eye = glm::normalize(view.camera.eye - geometry.point(pixel));
    return geometry.footprint_m(pixel) / towards_eye.y;
}

/// The detached strip: the pixels that the bias lights, off the borders of the wall's shadow.
struct Strip {
    double width_m = 0;
    double footprint_m = 0; ///< the widest there
    std::size_t pixels = 0;
    std::size_t others = 0; ///< false lit within the strip without the label peter-panning
};

/// @param foot_m  Up to this distance a texel's centre may lie before the wall, where the ground
///                shadows itself. The bias does not detach that shadow.
Strip measure_strip(const analysis::Comparison& result, double foot_m, double certain_m,
                    double largest_m)
{
    const analysis::ReceiverGeometry geometry{*result.triangles, result.view,
                                              result.receivers.triangle};
    Strip strip;
    for (std::size_t i = 0; i < result.truth.pixel_class.pixel_count(); ++i) {
        const Label label = result.diagnosis->causes.label[i];
        if (result.truth.pixel_class[i] != scene::PixelClass::blocked || label == Label::none) {
            continue;
        }
        const scene::Vec3d point = geometry.point(i);
        if (std::abs(point.z) > 1 || point.x > largest_m || point.y > 1e-6) {
            continue; // the wall is 4 m wide
        }
        if (label == Label::peter_panning) {
            ++strip.pixels;
            strip.width_m = std::max(strip.width_m, point.x);
            strip.footprint_m =
                std::max(strip.footprint_m, footprint_on_ground_m(geometry, result.view, i));
        } else if (point.x > foot_m && point.x < certain_m) {
            ++strip.others;
        }
    }
    return strip;
}

class WallGap : public testing::TestWithParam<int> {};

TEST_P(WallGap, IsTheBiasAndTheStripItsSine)
{
    GNOMON_REQUIRE_GL();
    const double angle_rad = GetParam() * std::numbers::pi / 180;
    const double shadow_m = 2 * std::tan(angle_rad); // of the 2 m high wall
    const Compared compared{wall_job(GetParam(), 0)};
    for (const double bias_m : {0.02, 0.05, 0.2}) {
        const auto result = compared(wall_job(GetParam(), bias_m));
        const double texel_m = result.view.first_map().texel_width_m(1, 4096);
        const double strip_m = bias_m * std::sin(angle_rad);
        // Half a texel on the light's plane is ½·texel·cos θ along the ground, and changes the
        // depth there by ½·texel·cot θ.
        const double half_texel_m = 0.5 * texel_m * std::cos(angle_rad);
        const Strip strip = measure_strip(result, 0.5 * texel_m / std::cos(angle_rad),
                                          strip_m - half_texel_m - 0.01, 0.6 * shadow_m);
        const auto label = fmt::format("{} deg, bias {} m", GetParam(), bias_m);
        EXPECT_GT(strip.pixels, 100U) << label;
        EXPECT_NEAR(strip.width_m, strip_m, half_texel_m + strip.footprint_m) << label;
        EXPECT_EQ(strip.others, 0U) << label;
        EXPECT_NEAR(double{result.diagnosis->peter_panning.metres->max}, bias_m,
                    0.5 * texel_m / std::tan(angle_rad) + strip.footprint_m / std::sin(angle_rad))
            << label;
    }
}

TEST(WallGapOfFilters, IsTheBiasWithinHalfTheFootprint)
{
    GNOMON_REQUIRE_GL();
    constexpr double angle_rad = std::numbers::pi / 4;
    constexpr double bias_m = 0.05;
    scene::Job job = wall_job(45, bias_m);
    if (!runs_full_tests()) {
        job.image = {640, 360};
    }
    const Compared compared{job};
    for (const scene::Filter filter :
         {scene::Filter::linear, scene::Filter::hardware, scene::Filter::pcf9}) {
        job.lookup.filter = filter;
        const auto result = compared(job);
        const double texel_m = result.view.first_map().texel_width_m(1, 4096);
        const Strip strip = measure_strip(result, 0, 0, 1.2);
        // A tap that the wall shadows is at most half the filter from P's. Pixels that only the
        // ground's own taps shadow lie a shadow's length away.
        const double reach_m = 0.5 * methods::filter_traits(filter).width_texels * texel_m;
        EXPECT_NEAR(double{result.diagnosis->peter_panning.metres->max}, bias_m,
                    reach_m / std::tan(angle_rad) + strip.footprint_m / std::sin(angle_rad))
            << methods::filter_traits(filter).width_texels << " texels";
    }
}

INSTANTIATE_TEST_SUITE_P(Angles, WallGap, testing::Values(20, 45, 70));

} // namespace
} // namespace gnomon::tests
