#include "analysis/limits/slope_curves.hpp"

#include "analysis/lookup/bias_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::PixelClass;
using testing::ElementsAre;

/// Lit ground of two tilts, sampled up to half a texel away, with blocked pixels close behind a
/// sheet.
struct Ground {
    static constexpr float per_texel = 0x1p-10F;
    static constexpr scene::ImageSize size{1000, 1};
    scene::LookupLayers samples{scene::Image<scene::LookupSample>{size}};
    scene::Image<PixelClass> classes{size, PixelClass::lit};
    PixelCauses causes{scene::Image<PixelCause>{size, {Cause::resolution, Cause::resolution, true}},
                       {}};

    Ground()
    {
        std::mt19937 random{1};
        std::uniform_real_distribution<float> offset{-0.5F, 0.5F};
        for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
            const float tan_theta = i % 2 == 0 ? 0.25F : 4.0F;
            const float depth_off = tan_theta * per_texel * offset(random);
            samples.samples[i] = {0.5F, 0.5F - depth_off, tan_theta, 0};
            if (i % 10 == 0) { // flat, behind a thin sheet
                classes[i] = PixelClass::blocked;
                samples.samples[i].map_depth = 0.5F - per_texel;
            }
        }
    }
    [[nodiscard]] SlopeInputs inputs() const { return {samples, {}, classes, causes, nullptr}; }
};

TEST(DefaultSlopes, SurroundTheNeedOfAPlane)
{
    EXPECT_THAT(default_slopes(0.5), ElementsAre(0.0F, 0.125F, 0.25F, 0.5F, 1.0F, 2.0F));
    EXPECT_THAT(default_slopes(1.0 / 3), ElementsAre(0.0F, 0.0833F, 0.167F, 0.333F, 0.667F, 1.33F));
    for (const double bad : {0.0, -1.0, 1e-300, std::nan("")}) {
        EXPECT_THROW((void)default_slopes(bad), std::invalid_argument) << bad;
    }
}

TEST(DefaultSlopes, ScaleWithTheFootprintsDepth)
{
    scene::LightFrustum frustum; // 2 m wide
    frustum.near_m = 1;
    frustum.far_m = 5;
    EXPECT_EQ(depth_per_footprint(frustum, 16, 1, 2), 0.125 / 4);
    EXPECT_EQ(depth_per_footprint(frustum, 16, 5, 2), 5 * 0.125 / 4);
    frustum.projection = scene::Projection::perspective;
    // Texels of ζ/8, depth falling off with 1/(A ζ²), A = 0.8.
    EXPECT_DOUBLE_EQ(depth_per_footprint(frustum, 16, 1, 2), 1 / (8 * 0.8 * 2));
}

TEST(SlopeCurve, EqualsTheCurveOfItsCriticalBiases)
{
    const Ground ground;
    for (const float slope : {0.0F, 0.5F * Ground::per_texel, -Ground::per_texel}) {
        LookupRule rule;
        rule.slope = slope;
        const auto criticals = critical_biases(ground.samples, rule);
        const BiasCurve curve{criticals, ground.classes};
        const SlopeCurve found = slope_curve(ground.inputs(), slope);
        EXPECT_EQ(found.slope, slope);
        EXPECT_EQ(found.curve.lit(), curve.lit());
        EXPECT_EQ(found.curve.blocked(), curve.blocked());
        EXPECT_EQ(found.best.interval, find_best_biases(curve).interval);
        EXPECT_EQ(found.bounds.strict.acne_free, curve.lit().back());
    }
}

TEST(SlopeCurve, ServesGroundThatNoConstantBiasServes)
{
    const Ground ground;
    // The steep half needs up to 2 texels' depth, but the sheet is only one texel's depth in front.
    EXPECT_TRUE(slope_curve(ground.inputs(), 0).bounds.no_constant_bias_serves);
    // A slope of ½ serves every tilt.
    const SlopeCurve sloped = slope_curve(ground.inputs(), 0.5F * Ground::per_texel);
    EXPECT_EQ(sloped.best.errors.total(), 0U);
    EXPECT_FALSE(sloped.bounds.no_constant_bias_serves);
    EXPECT_EQ(sloped.curve.at(sloped.best.interval.middle()).total(), 0U);
}

} // namespace
} // namespace gnomon::analysis
