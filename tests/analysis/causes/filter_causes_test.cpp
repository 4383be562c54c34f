#include "one_pixel.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace gnomon::analysis {
namespace {

using scene::Filter;
using scene::infinity;
using scene::Outside;
using scene::PixelClass;

TEST(Causes, PcfIsRepairedWhenTheMiddleTapIs)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(0, 0);
    // Critical biases ½ − depth: four taps at 0, then 1/8 as the fifth, four at ½.
    for (int i = 0; i < 9; ++i) {
        pixel.sees(3 + i % 3, 3 + i / 3, i < 4 ? 0.5 : (i == 4 ? 0.375 : 0.0));
    }
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.125F);
    expect_cause(pixel.classified({0.125F, 0, 0}), Cause::precision, Label::edge);
    expect_cause(pixel.classified({0.124F, 0, 0}), Cause::resolution, Label::edge);
}

TEST(Causes, EqualDepthsAmongPcfTapsAreRanked)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(0, 0);
    for (int i = 0; i < 9; ++i) {
        pixel.sees(3 + i % 3, 3 + i / 3, i < 2 ? 0.5 : 0.25);
    }
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.25F);
}

TEST(Causes, BorderTapsOfPcfCountAsTheyDecide)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings = {Filter::pcf3, Outside::shadowed};
    pixel.unbiased.texels[0] = {0.5F, 0.5F}; // five of nine taps are outside
    pixel.lookup.texels[0] = {0.5F, 0.5F};
    pixel.verdicts(0, 0);
    EXPECT_EQ(pixel.found().exact_critical_bias, infinity);
    expect_cause(pixel.classified({1, 0, 0}), Cause::filter,
                 Label::edge); // the centre texel is lit
}

TEST(Causes, ReversedDepthsAreReadTheOtherWay)
{
    OnePixel pixel{PixelClass::lit};
    pixel.reversed = true;
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(0, 0);
    for (int i = 0; i < 9; ++i) { // nearer is greater
        pixel.sees(3 + i % 3, 3 + i / 3, i < 4 ? 0.5 : (i == 4 ? 0.625 : 1.0));
    }
    // The fake's critical biases are r − d: the fifth smallest depth is 5/8.
    EXPECT_EQ(pixel.found().exact_critical_bias, -0.125F);
}

TEST(Causes, AcneNeedsHalfOfTheShadowingTapsOnTheSelfShadowingSurface)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(0, 0);
    // Six taps shadow; the map's rows are counted from the top.
    for (int i = 0; i < 9; ++i) {
        const int x = 3 + i % 3;
        const int y = 3 + i / 3;
        pixel.map_depths(x, OnePixel::resolution - 1 - y) = i < 6 ? 0.25F : 0.75F;
        pixel.sees(x, y, 0.25, 1, static_cast<std::uint32_t>(i));
    }
    pixel.light.own = {{0, 0}, {0, 1}, {0, 8}}; // triangle 8 is seen by a tap that does not shadow
    expect_cause(pixel.classified(), Cause::resolution, Label::edge);
    pixel.light.own.insert({0, 2});
    expect_cause(pixel.classified(), Cause::resolution, Label::acne);
}

TEST(Causes, LinearComparesTheInterpolatedDepth)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::linear;
    pixel.unbiased.texels[0] = {4.75F, 4.5F}; // ¾ of texel (4, 4), ¼ of (5, 4)
    pixel.light.places[0] = pixel.unbiased.texels[0];
    pixel.verdicts(0, 0).sees(4, 4, 0.5).sees(5, 4, 0.25);
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.0625F);
}

TEST(Causes, HardwareComparesEachTapAndWeighsTheVerdicts)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::hardware;
    pixel.verdicts(0, 0);
    pixel.unbiased.texels[0] = {4.75F, 4.5F};
    pixel.sees(4, 4, 0.375).sees(5, 4, 0.5);
    EXPECT_EQ(pixel.found().exact_critical_bias,
              0.125F); // ¾ of the weight is lit only when texel (4, 4) is
    pixel.unbiased.texels[0] = {5.25F, 4.5F};
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.0F); // ¾ of it is lit without bias
}

TEST(Causes, OutsideTheMapLinearTapsAreAsFarOrNearAsTheBorderModeSays)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings = {Filter::linear, Outside::shadowed};
    pixel.unbiased.texels[0] = {0.25F, 4.5F}; // ¼ of its depth comes from outside: 0
    pixel.light.places[0] = pixel.unbiased.texels[0];
    pixel.verdicts(0, 0).sees(0, 4, 0.5);
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.125F);
    pixel.settings.outside = Outside::lit;
    EXPECT_EQ(pixel.found().exact_critical_bias, -0.125F);
}

TEST(Causes, OfPartialPixelsAreFoundLikeThoseOfWrongOnes)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(8.0F / 9, 8.0F / 9).sees_everywhere(0.75F);
    pixel.sees(3, 3, 0.25).stores(3, 3, 0.25F); // one tap shadows, but not the centre
    const CauseLayers layers = pixel.classified();
    EXPECT_EQ(layers.cause[0], Cause::filter);
    EXPECT_EQ(layers.label[0], Label::edge);
    EXPECT_EQ(layers.counts.of(Cause::filter), 0U); // the pixel is partial, not wrong
    EXPECT_DOUBLE_EQ(layers.amounts.of(Cause::filter), 1.0 / 9);
    EXPECT_DOUBLE_EQ(layers.amounts.of(Label::edge), 1.0 / 9);
    EXPECT_DOUBLE_EQ(layers.amounts.shadow_softening, 1.0 / 9);
    EXPECT_EQ(layers.amounts.light_softening, 0);
    // Exact depths at which a bias lights every tap repair it.
    pixel.sees(3, 3, 0.4375);
    EXPECT_EQ(pixel.classified({0.0625F, 0, 0}).cause[0], Cause::precision);
    EXPECT_EQ(pixel.classified({0.03125F, 0, 0}).cause[0], Cause::filter);
}

TEST(Causes, APartialPixelThatIsRightWithoutBiasIsSoByBias)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(1.0F / 9, 0).sees_everywhere(0.25F);
    const CauseLayers layers = pixel.classified();
    EXPECT_EQ(layers.cause[0], Cause::bias);
    EXPECT_EQ(layers.label[0], Label::peter_panning);
    EXPECT_DOUBLE_EQ(layers.amounts.of(Label::peter_panning), 1.0 / 9);
}

TEST(Causes, SmallDifferencesHaveNone)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::hardware;
    pixel.verdicts(1 - 1.0F / 256, 1 - 1.0F / 256);
    EXPECT_EQ(pixel.classified().cause[0], Cause::none);
    EXPECT_EQ(pixel.classified().amounts.of(Label::edge), 0);
    pixel.verdicts(1 - 1.0F / 128, 1 - 1.0F / 128);
    EXPECT_NE(pixel.classified().cause[0], Cause::none);
}

TEST(Causes, OwnShadowsThatTheBiasCuredLeaveTheFilter)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(0, 0).sees_everywhere(0.25F, 9);
    pixel.sees(4, 4, 0.25, 1, 7)
        .stores(4, 4, 0.4375F); // the centre tap sees the self-shadowing surface
    pixel.light.own.insert({0, 7});
    // Exact depths shadow it up to ¼, GL's own up to 1/16; above that the bias cures it.
    expect_cause(pixel.classified({0.03125F, 0, 0}), Cause::resolution, Label::edge);
    expect_cause(pixel.classified({0.0625F, 0, 0}), Cause::filter, Label::edge);
    // Another texel of its self-shadowing surface is still shadowed.
    pixel.light.own.insert({0, 8});
    pixel.sees(3, 3, 0.25, 1, 8);
    expect_cause(pixel.classified({0.0625F, 0, 0}), Cause::resolution, Label::edge);
}

TEST(Causes, AFilterWithoutAShadowingTexelOvershadows)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::linear;
    // Interpolated between two texels' exact depths it is shadowed; by the centre's alone, or by
    // all stored ones, it is not.
    pixel.unbiased.texels[0] = {4.75F, 4.5F};
    pixel.light.places[0] = pixel.unbiased.texels[0];
    pixel.lookup.texels[0] = {4.75F, 4.5F};
    pixel.verdicts(0, 0).sees(4, 4, 0.5).sees(5, 4, 0.25);
    expect_cause(pixel.classified(), Cause::filter, Label::overshadow);
    pixel.stores(5, 4, 0.25F);
    expect_cause(pixel.classified(), Cause::filter, Label::edge);
    pixel.light.own.insert({0, 7});
    pixel.sees(4, 4, 0.4375);
    expect_cause(pixel.classified(), Cause::resolution,
                 Label::acne); // a texel of its surface shadows it
}

TEST(Causes, TheAmountOfALitPixelIsDividedAmongItsShadowingTaps)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(0, 0).sees_everywhere(0.25F, 9);
    for (int i = 0; i < 4; ++i) {
        pixel.sees(3 + i % 3, 3 + i / 3, 0.25, 1, 7);
    }
    pixel.light.own.insert({0, 7});
    const CauseLayers layers = pixel.classified();
    EXPECT_EQ(layers.label[0], Label::edge); // four of nine
    EXPECT_EQ(layers.amounts.of(Cause::resolution), 1);
    EXPECT_DOUBLE_EQ(layers.amounts.of(Label::acne), 4.0 / 9);
    EXPECT_DOUBLE_EQ(layers.amounts.of(Label::edge), 5.0 / 9);
    EXPECT_EQ(layers.amounts.softening(), 0); // softening is not the filter's here
}

TEST(Causes, OfHardwareShareTheVerdictsAmountByWeight)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::hardware;
    pixel.unbiased.texels[0] = {4.75F, 4.5F}; // ¾ of texel (4, 4), ¼ of (5, 4)
    pixel.lookup.texels[0] = {4.75F, 4.5F};
    pixel.verdicts(0.125F, 0.125F).stores(4, 4, 0.25F).stores(5, 4, 0.25F);
    pixel.sees(4, 4, 0.25, 1, 7).sees(5, 4, 0.25, 1, 9);
    pixel.light.own.insert({0, 7});
    const CauseLayers layers = pixel.classified();
    expect_cause(layers, Cause::resolution, Label::acne);
    EXPECT_NEAR(layers.amounts.of(Label::acne), 0.75 * 0.875, 0x1p-31);
    EXPECT_NEAR(layers.amounts.of(Label::edge), 0.25 * 0.875, 0x1p-31);
}

TEST(Causes, OwnShadowRepairsNoTapOfAFilter)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(1, 0).sees_everywhere(0.25F, 9);
    expect_cause(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.light.own.insert({0, 7});
    for (int i = 0; i < 5; ++i) {
        pixel.sees(3 + i % 3, 3 + i / 3, 0.25, 1, 7); // including the centre
    }
    expect_cause(pixel.classified(), Cause::coverage, Label::leak);
    pixel.sees(4, 4, 0.25, 1, 9); // now only four of nine are self-shadowing; the others suffice
    expect_cause(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.stores(4, 4, 0.75F).verdicts(1, 1.0F / 9); // except that GL stored one depth wrong
    expect_cause(pixel.classified(), Cause::precision, Label::leak);
}

TEST(Causes, TheCentreTexelRepairsAFilter)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(8.0F / 9, 8.0F / 9).sees_everywhere(0.75F);
    pixel.sees(4, 4, 0.25).stores(4, 4, 0.25F);
    const CauseLayers layers = pixel.classified();
    expect_cause(layers, Cause::filter, Label::edge);
    EXPECT_DOUBLE_EQ(layers.amounts.light_softening, 8.0 / 9);
    pixel.light.own.insert({0, 7});
    EXPECT_NE(pixel.classified().cause[0], Cause::filter);
}

TEST(Causes, LinearIsNotRepairedWhereItsCentreSeesItsSelfShadowingSurface)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.filter = Filter::linear;
    pixel.verdicts(1, 0).sees(4, 4, 0.25).sees(5, 4, 0.25, 1, 9);
    pixel.unbiased.texels[0] = {4.75F, 4.5F};
    expect_cause(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.light.own.insert({0, 9}); // another texel of the footprint
    expect_cause(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.light.own.insert({0, 7});
    expect_cause(pixel.classified(), Cause::coverage, Label::leak);
}

TEST(Causes, TheFootprintItselfIsLookedAtForTheBlocker)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(1, 1).sees_everywhere(0.75F);
    pixel.light.crossed.insert(0);
    pixel.light.blockers[0] = {3, 6, 4, 10};
    for (int i = 0; i < 9; ++i) {
        pixel.sees(3 + i % 3, 3 + i / 3, 0.75, 12);
    }
    expect_cause(pixel.classified(), Cause::resolution, Label::leak);
    pixel.sees(3, 3, 0.25, 5);
    expect_cause(pixel.classified(), Cause::resolution, Label::edge);
}

} // namespace
} // namespace gnomon::analysis
