#include "analysis/bias/bias_rows.hpp"
#include "analysis/causes/blocked_causes.hpp"
#include "analysis/causes/lit_causes.hpp"

#include "fake_light.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace gnomon::analysis {
namespace {

using scene::Filter;
using scene::infinity;
using scene::Outside;
using scene::PixelClass;

constexpr int resolution = 8;
constexpr float not_a_depth = std::numeric_limits<float>::quiet_NaN();

/// One pixel before a map of 8×8 texels, looked up at the centre of texel (4, 4) with r = ½.
struct OnePixel {
    scene::LookupSettings settings{Filter::nearest, Outside::lit};
    bool reversed = false;
    scene::TruthLayers truth;
    scene::LookupLayers lookup;   ///< with the job's bias
    scene::LookupLayers unbiased; ///< without
    scene::Image<float> map_depths{{resolution, resolution}, 1.0F};
    FakeLight light;

    explicit OnePixel(PixelClass pixel_class)
    {
        truth.pixel_class = scene::Image<PixelClass>{{1, 1}, pixel_class};
        unbiased.samples = scene::Image<scene::LookupSample>{{1, 1}, {0.5F, 0.5F, 0, 1}};
        unbiased.texels = scene::Image<scene::Vec2f>{{1, 1}, {4.5F, 4.5F}};
        lookup = unbiased;
        light.receiver_depths[0] = 0.5;
        light.places[0] = unbiased.texels[0];
    }

    /// What the map without bias, and the job's lookup, say.
    OnePixel& verdicts(float v0, float v1)
    {
        lookup.samples[0].verdict = v0;
        unbiased.samples[0].verdict = v1;
        unbiased.samples[0].map_depth = v1 < 0.5F ? 0.25F : 0.5F;
        lookup.samples[0].map_depth = unbiased.samples[0].map_depth;
        return *this;
    }
    OnePixel& sees(int x, int y, double depth, double light_distance_m = 1,
                   std::uint32_t triangle = 7)
    {
        light.hits[{x, y}] = {triangle, depth, light_distance_m};
        return *this;
    }

    /// What GL stored in a texel.
    OnePixel& stores(int x, int y, float depth)
    {
        map_depths(x, resolution - 1 - y) = depth;
        return *this;
    }
    /// All taps of a 3 × 3 lookup see, and have stored, the same.
    OnePixel& sees_everywhere(float depth, std::uint32_t triangle = 7)
    {
        for (int i = 0; i < 9; ++i) {
            sees(3 + i % 3, 3 + i / 3, double{depth}, 1, triangle);
            stores(3 + i % 3, 3 + i / 3, depth);
        }
        return *this;
    }

    [[nodiscard]] PixelCauses causes() const
    {
        const bool has_filter = settings.filter != Filter::nearest;
        PixelCauses found{scene::Image<PixelCause>{{1, 1}},
                          scene::Image<FilterCause>{scene::ImageSize{has_filter ? 1 : 0, 1}}};
        const CauseInputs inputs{settings, resolution, reversed,   truth,
                                 lookup,   unbiased,   map_depths, light};
        find_lit_causes(inputs, found);
        const bool is_blocked = truth.pixel_class[0] == PixelClass::blocked;
        find_blocked_causes(
            inputs,
            scene::Image<std::uint8_t>{{1, 1}, is_blocked ? std::uint8_t{1} : std::uint8_t{0}},
            found);
        return found;
    }
    [[nodiscard]] PixelCause found() const { return causes().pixels[0]; }
    [[nodiscard]] CauseLayers classified(const scene::Bias& bias = {}) const
    {
        const PixelCauses pixels = causes();
        const scene::Image<float> verdicts = criticals_of_verdicts(lookup);
        const LookupRule rule{settings.filter, settings.outside, reversed, bias.slope};
        const TapCriticals taps{lookup, map_depths, rule};
        return classify_errors({truth.pixel_class, lookup, verdicts, pixels, rule,
                                settings.filter == Filter::nearest ? nullptr : &taps, true},
                               bias.constant);
    }
};

void expect(const CauseLayers& layers, Cause cause, Label label)
{
    EXPECT_EQ(cause_names[static_cast<std::size_t>(layers.cause[0])],
              cause_names[static_cast<std::size_t>(cause)]);
    EXPECT_EQ(label_names[static_cast<std::size_t>(layers.label[0])],
              label_names[static_cast<std::size_t>(label)]);
    EXPECT_EQ(layers.counts.of(cause), 1U);
    EXPECT_EQ(layers.counts.of(label), 1U);
}

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
    expect(OnePixel{PixelClass::blocked}.verdicts(1, 0).classified(), Cause::bias,
           Label::peter_panning);
    expect(OnePixel{PixelClass::lit}.verdicts(0, 1).classified(), Cause::bias, Label::overshadow);
}

TEST(Causes, ExactDepthsThatTheKeptBiasLightsMakeItPrecision)
{
    OnePixel pixel{PixelClass::lit};
    pixel.verdicts(0, 0).sees(4, 4, 0.4375); // the exact critical bias is 1/16
    pixel.light.own.insert({0, 7});
    expect(pixel.classified({0.0625F, 0, 0}), Cause::precision, Label::acne);
    expect(pixel.classified({std::nextafter(0.0625F, 0.0F), 0, 0}), Cause::resolution, Label::acne);
}

TEST(Causes, TheSlopesPartOfTheBiasIsKeptToo)
{
    OnePixel pixel{PixelClass::lit};
    pixel.verdicts(0, 0).sees(4, 4, 0.4375);
    pixel.lookup.samples[0].tan_theta = 2;
    expect(pixel.classified({0.03125F, 0.015625F, 0}), Cause::precision, Label::edge);
}

TEST(Causes, AnotherSheetIsAnEdge)
{
    OnePixel pixel{PixelClass::lit};
    expect(pixel.verdicts(0, 0).sees(4, 4, 0.25).classified(), Cause::resolution, Label::edge);
}

TEST(Causes, WhatTheExactTexelsShadowWasLostToPrecision)
{
    OnePixel pixel{PixelClass::blocked};
    expect(pixel.verdicts(1, 1).sees(4, 4, 0.4999).classified(), Cause::precision, Label::leak);
}

TEST(Causes, WhatLiesBetweenTexelsWasLostToResolution)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.verdicts(1, 1).sees(4, 4, 0.5, 10);
    pixel.light.crossed.insert(0);
    pixel.light.blockers[0] = {3, 6, 4, 10}; // the middle is at ζ = 7
    expect(pixel.classified(), Cause::resolution, Label::leak);
    pixel.sees(5, 5, 0.2, 7.5);
    expect(pixel.classified(), Cause::resolution, Label::leak);
    pixel.sees(3, 4, 0.2, 6.5);
    expect(pixel.classified(), Cause::resolution, Label::edge);
}

TEST(Causes, WhatNoInfinitelyFineMapSeesIsCoverage)
{
    OnePixel pixel{PixelClass::blocked};
    expect(pixel.verdicts(1, 1).sees(4, 4, 0.5).classified(), Cause::coverage, Label::leak);
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
        expect(pixel.classified({1, 0, 0}), Cause::coverage,
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
        expect(pixel.verdicts(1, 1).classified(), Cause::coverage, Label::leak);
    }
}

TEST(Causes, ClampedLookupsOutsideTheMapCannotBeRepairedByAFinerOne)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.outside = Outside::clamp;
    pixel.unbiased.texels[0] = {9.5F, 4.5F};
    pixel.light.crossed.insert(0);
    expect(pixel.verdicts(1, 1).sees(7, 4, 0.5).classified(), Cause::coverage, Label::leak);
    pixel.sees(7, 4, 0.4);
    expect(pixel.classified(), Cause::precision, Label::leak);
}

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
    expect(pixel.classified({0.125F, 0, 0}), Cause::precision, Label::edge);
    expect(pixel.classified({0.124F, 0, 0}), Cause::resolution, Label::edge);
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
    expect(pixel.classified({1, 0, 0}), Cause::filter, Label::edge); // the centre texel is lit
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
        pixel.map_depths(x, resolution - 1 - y) = i < 6 ? 0.25F : 0.75F;
        pixel.sees(x, y, 0.25, 1, static_cast<std::uint32_t>(i));
    }
    pixel.light.own = {{0, 0}, {0, 1}, {0, 8}}; // triangle 8 is seen where nothing shadows
    expect(pixel.classified(), Cause::resolution, Label::edge);
    pixel.light.own.insert({0, 2});
    expect(pixel.classified(), Cause::resolution, Label::acne);
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
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.125F); // ¾ of the weight waits for texel (4, 4)
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
    pixel.sees(3, 3, 0.25).stores(3, 3, 0.25F); // one tap shadows: the centre does not
    const CauseLayers layers = pixel.classified();
    EXPECT_EQ(layers.cause[0], Cause::filter);
    EXPECT_EQ(layers.label[0], Label::edge);
    EXPECT_EQ(layers.counts.of(Cause::filter), 0U); // it is not wrong
    EXPECT_DOUBLE_EQ(layers.amounts.of(Cause::filter), 1.0 / 9);
    EXPECT_DOUBLE_EQ(layers.amounts.of(Label::edge), 1.0 / 9);
    EXPECT_DOUBLE_EQ(layers.amounts.shadow_softening, 1.0 / 9);
    EXPECT_EQ(layers.amounts.light_softening, 0);
    // Exact depths that a bias lights at every tap repair it.
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
    pixel.sees(4, 4, 0.25, 1, 7).stores(4, 4, 0.4375F); // the centre: its self-shadowing surface
    pixel.light.own.insert({0, 7});
    // Exact depths would shadow it up to ¼, GL's own up to 1/16: above that the bias has cured it.
    expect(pixel.classified({0.03125F, 0, 0}), Cause::resolution, Label::edge);
    expect(pixel.classified({0.0625F, 0, 0}), Cause::filter, Label::edge);
    // Another texel of its self-shadowing surface is still shadowed.
    pixel.light.own.insert({0, 8});
    pixel.sees(3, 3, 0.25, 1, 8);
    expect(pixel.classified({0.0625F, 0, 0}), Cause::resolution, Label::edge);
}

TEST(Causes, TheFilterIsNoneOfNearest)
{
    OnePixel pixel{PixelClass::lit};
    pixel.light.own.insert({0, 7});
    expect(pixel.verdicts(0, 0).sees(4, 4, 0.25).classified(), Cause::resolution, Label::acne);
}

TEST(Causes, AFilterWithoutAShadowingTexelOvershadows)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::linear;
    // Between two texels' exact depths it is shadowed; the centre's alone, and all stored ones,
    // not.
    pixel.unbiased.texels[0] = {4.75F, 4.5F};
    pixel.light.places[0] = pixel.unbiased.texels[0];
    pixel.lookup.texels[0] = {4.75F, 4.5F};
    pixel.verdicts(0, 0).sees(4, 4, 0.5).sees(5, 4, 0.25);
    expect(pixel.classified(), Cause::filter, Label::overshadow);
    pixel.stores(5, 4, 0.25F);
    expect(pixel.classified(), Cause::filter, Label::edge);
    pixel.light.own.insert({0, 7});
    pixel.sees(4, 4, 0.4375);
    expect(pixel.classified(), Cause::resolution, Label::acne); // a texel of its surface shadows it
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
    EXPECT_EQ(layers.amounts.softening(), 0); // it is not the filter's
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
    expect(layers, Cause::resolution, Label::acne);
    EXPECT_NEAR(layers.amounts.of(Label::acne), 0.75 * 0.875, 0x1p-31);
    EXPECT_NEAR(layers.amounts.of(Label::edge), 0.25 * 0.875, 0x1p-31);
}

TEST(Causes, OwnShadowRepairsNoBlockedPixel)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.verdicts(1, 0).sees(4, 4, 0.25);
    expect(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.light.own.insert({0, 7}); // V1, and exact depths, are right by its own shadow alone
    expect(pixel.classified(), Cause::coverage, Label::leak);
    pixel.light.crossed.insert(0);
    pixel.light.blockers[0] = {3, 6, 4, 10};
    expect(pixel.classified(), Cause::resolution, Label::leak);
}

TEST(Causes, OwnShadowRepairsNoTapOfAFilter)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(1, 0).sees_everywhere(0.25F, 9);
    expect(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.light.own.insert({0, 7});
    for (int i = 0; i < 5; ++i) {
        pixel.sees(3 + i % 3, 3 + i / 3, 0.25, 1, 7); // the centre among them
    }
    expect(pixel.classified(), Cause::coverage, Label::leak);
    pixel.sees(4, 4, 0.25, 1, 9); // now four of nine are its own: the others are enough
    expect(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.stores(4, 4, 0.75F).verdicts(1, 1.0F / 9); // but for a depth that GL stored wrong
    expect(pixel.classified(), Cause::precision, Label::leak);
}

TEST(Causes, TheCentreTexelRepairsAFilter)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(8.0F / 9, 8.0F / 9).sees_everywhere(0.75F);
    pixel.sees(4, 4, 0.25).stores(4, 4, 0.25F);
    const CauseLayers layers = pixel.classified();
    expect(layers, Cause::filter, Label::edge);
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
    expect(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.light.own.insert({0, 9}); // another texel of the footprint
    expect(pixel.classified(), Cause::bias, Label::peter_panning);
    pixel.light.own.insert({0, 7});
    expect(pixel.classified(), Cause::coverage, Label::leak);
}

TEST(Causes, SelfShadowingAroundTheFootprintHidesNoLeak)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.verdicts(1, 1).sees(4, 4, 0.5, 10).sees(5, 4, 0.2, 5, 9);
    pixel.light.crossed.insert(0);
    pixel.light.blockers[0] = {3, 6, 4, 10}; // the middle is at ζ = 7
    expect(pixel.classified(), Cause::resolution, Label::edge);
    pixel.light.own.insert({0, 9});
    expect(pixel.classified(), Cause::resolution, Label::leak);
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
    expect(pixel.classified(), Cause::resolution, Label::leak);
    pixel.sees(3, 3, 0.25, 5);
    expect(pixel.classified(), Cause::resolution, Label::edge);
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
