#include "one_pixel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::Filter;
using scene::Outside;
using scene::PixelClass;

constexpr float not_a_depth = std::numeric_limits<float>::quiet_NaN();

TEST(Causes, RightPixelsAndThoseNotScoredHaveNone)
{
    for (const PixelClass pixel_class : {PixelClass::lit, PixelClass::attached}) {
        OnePixel pixel{pixel_class};
        pixel.verdicts(1, pixel_class == PixelClass::lit ? 1 : 0);
        const CauseLayers layers = pixel.classified();
        EXPECT_EQ(layers.cause[0], Cause::none);
        EXPECT_EQ(layers.label[0], Label::none);
        EXPECT_EQ(layers.counts.of(Cause::none), 0U);
        EXPECT_EQ(pixel.light.traced_texels, 0U);
    }
}

TEST(Causes, WhatIsRightWithoutBiasIsWrongByBias)
{
    expect_cause(OnePixel{PixelClass::blocked}.verdicts(1, 0).classified(), Cause::bias,
                 Label::peter_panning);
    expect_cause(OnePixel{PixelClass::lit}.verdicts(0, 1).classified(), Cause::bias,
                 Label::overshadow);
}

TEST(Causes, ExactDepthsThatTheKeptBiasLightsMakeItPrecision)
{
    OnePixel pixel{PixelClass::lit};
    pixel.verdicts(0, 0).sees(4, 4, 0.4375); // the exact critical bias is 1/16
    pixel.light.own.insert({0, 7});
    expect_cause(pixel.classified({0.0625F, 0, 0}), Cause::precision, Label::acne);
    expect_cause(pixel.classified({std::nextafter(0.0625F, 0.0F), 0, 0}), Cause::resolution,
                 Label::acne);
}

TEST(Causes, TheSlopesPartOfTheBiasIsKeptToo)
{
    OnePixel pixel{PixelClass::lit};
    pixel.verdicts(0, 0).sees(4, 4, 0.4375);
    pixel.lookup.samples[0].tan_theta = 2;
    expect_cause(pixel.classified({0.03125F, 0.015625F, 0}), Cause::precision, Label::edge);
}

TEST(Causes, AnotherSheetIsAnEdge)
{
    OnePixel pixel{PixelClass::lit};
    expect_cause(pixel.verdicts(0, 0).sees(4, 4, 0.25).classified(), Cause::resolution,
                 Label::edge);
}

TEST(Causes, WhatTheExactTexelsShadowWasLostToPrecision)
{
    OnePixel pixel{PixelClass::blocked};
    expect_cause(pixel.verdicts(1, 1).sees(4, 4, 0.4999).classified(), Cause::precision,
                 Label::leak);
}

TEST(Causes, WhatLiesBetweenTexelsWasLostToResolution)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.verdicts(1, 1).sees(4, 4, 0.5, 10);
    pixel.light.crossed.insert(0);
    pixel.light.blockers[0] = {3, 6, 4, 10}; // the middle is at ζ = 7
    expect_cause(pixel.classified(), Cause::resolution, Label::leak);
    pixel.sees(5, 5, 0.2, 7.5);
    expect_cause(pixel.classified(), Cause::resolution, Label::leak);
    pixel.sees(3, 4, 0.2, 6.5);
    expect_cause(pixel.classified(), Cause::resolution, Label::edge);
}

TEST(Causes, WhatNoInfinitelyFineMapSeesIsCoverage)
{
    OnePixel pixel{PixelClass::blocked};
    expect_cause(pixel.verdicts(1, 1).sees(4, 4, 0.5).classified(), Cause::coverage, Label::leak);
}

TEST(Causes, TheBorderModeOutsideTheMapLeavesOnlyCoverage)
{
    for (const PixelClass truth : {PixelClass::lit, PixelClass::blocked}) {
        const bool is_lit = truth == PixelClass::lit;
        OnePixel pixel{truth};
        pixel.settings.outside = is_lit ? Outside::shadowed : Outside::lit;
        pixel.unbiased.texels[0] = {9.5F, 4.5F};
        pixel.verdicts(is_lit ? 0 : 1, is_lit ? 0 : 1);
        pixel.unbiased.samples[0].map_depth = not_a_depth;
        pixel.light.crossed.insert(0);
        expect_cause(pixel.classified({1, 0, 0}), Cause::coverage,
                     is_lit ? Label::overshadow : Label::leak);
        EXPECT_EQ(pixel.light.traced_texels, 0U);
    }
}

TEST(Causes, BeyondTheFarPlaneTheBorderModeDecides)
{
    for (const bool reversed : {false, true}) {
        OnePixel pixel{PixelClass::blocked};
        pixel.reversed = reversed;
        pixel.unbiased.samples[0].receiver_depth = reversed ? -0.001F : 1.001F;
        pixel.light.crossed.insert(0);
        expect_cause(pixel.verdicts(1, 1).classified(), Cause::coverage, Label::leak);
    }
}

TEST(Causes, ClampedLookupsOutsideTheMapCannotBeRepairedByAFinerOne)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.outside = Outside::clamp;
    pixel.unbiased.texels[0] = {9.5F, 4.5F};
    pixel.light.crossed.insert(0);
    expect_cause(pixel.verdicts(1, 1).sees(7, 4, 0.5).classified(), Cause::coverage, Label::leak);
    pixel.sees(7, 4, 0.4);
    expect_cause(pixel.classified(), Cause::precision, Label::leak);
}

TEST(Causes, TheFilterIsNoneOfNearest)
{
    OnePixel pixel{PixelClass::lit};
    pixel.light.own.insert({0, 7});
    expect_cause(pixel.verdicts(0, 0).sees(4, 4, 0.25).classified(), Cause::resolution,
                 Label::acne);
}

TEST(Causes, OwnShadowRepairsNoBlockedPixel)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.verdicts(1, 0).sees(4, 4, 0.25);
    expect_cause(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.light.own.insert({0, 7}); // V1 and exact depths are right only by self-shadowing
    expect_cause(pixel.classified(), Cause::coverage, Label::leak);
    pixel.light.crossed.insert(0);
    pixel.light.blockers[0] = {3, 6, 4, 10};
    expect_cause(pixel.classified(), Cause::resolution, Label::leak);
}

TEST(Causes, SelfShadowingAroundTheFootprintHidesNoLeak)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.verdicts(1, 1).sees(4, 4, 0.5, 10).sees(5, 4, 0.2, 5, 9);
    pixel.light.crossed.insert(0);
    pixel.light.blockers[0] = {3, 6, 4, 10}; // the middle is at ζ = 7
    expect_cause(pixel.classified(), Cause::resolution, Label::edge);
    pixel.light.own.insert({0, 9});
    expect_cause(pixel.classified(), Cause::resolution, Label::leak);
}

TEST(Causes, AcneDoesNotDependOnTheBias)
{
    OnePixel pixel{PixelClass::lit};
    pixel.verdicts(0, 0).sees(4, 4, 0.4375);
    EXPECT_FALSE(is_acne_if_shadowed(pixel.found(), PixelClass::lit));
    pixel.light.own.insert({0, 7});
    EXPECT_TRUE(is_acne_if_shadowed(pixel.found(), PixelClass::lit));
    EXPECT_FALSE(is_acne_if_shadowed(pixel.found(), PixelClass::blocked));
}

TEST(Causes, LayersOfOtherSizesAreRejected)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::pcf3;
    pixel.map_depths = scene::Image<float>{};
    EXPECT_THROW((void)pixel.found(), std::invalid_argument);
    OnePixel other{PixelClass::lit};
    other.unbiased.samples = scene::Image<scene::LookupSample>{{2, 1}};
    EXPECT_THROW((void)other.found(), std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
