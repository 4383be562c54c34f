// Tests the bias terms that V2 keeps for a lit pixel, and lookups that float32 displaces.

#include "one_pixel.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

namespace gnomon::analysis {
namespace {

using scene::Filter;
using scene::infinity;
using scene::Outside;
using scene::PixelClass;

TEST(KeptTerms, TakeOffTheDepthWhatTheLookupTook)
{
    OnePixel pixel{PixelClass::lit};
    pixel.verdicts(0, 0).sees(4, 4, 0.375);
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.125F);
    expect_cause(pixel.classified(), Cause::resolution, Label::edge);
    pixel.moved({0, 0, 0, 0.125F});
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.0F);
    expect_cause(pixel.classified(), Cause::precision, Label::edge);
}

TEST(KeptTerms, LookWhereTheOffsetLeads)
{
    OnePixel pixel{PixelClass::lit};
    pixel.lookup.texels[0] = {5.5F, 4.5F};
    pixel.verdicts(0, 0).sees(4, 4, 0.25).sees(5, 4, 0.5);
    expect_cause(pixel.classified(), Cause::resolution, Label::edge);
    pixel.moved({1, 0, 0, 0});
    expect_cause(pixel.classified(), Cause::precision, Label::edge);
}

TEST(KeptTerms, LeaveABlockedPixelAtTheReceiver)
{
    OnePixel pixel{PixelClass::blocked};
    pixel.lookup.texels[0] = {5.5F, 4.5F};
    pixel.verdicts(1, 1).sees(4, 4, 0.25).sees(5, 4, 0.75).moved({1, 0, 0, 0.5F});
    expect_cause(pixel.classified(), Cause::precision, Label::leak);
}

TEST(KeptTerms, CompareEachTapWithWhatThePlaneRisesTo)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::pcf3;
    pixel.verdicts(0, 0).sees_everywhere(0.25).moved({0, 0, 0, 0});
    // Columns at −1, 0 and 1 texel: r less 1/16, r, and r more 1/16.
    pixel.terms->lookup.gradients = scene::Image<scene::Vec2f>{{1, 1}, {0.0625F, 0}};
    const PixelCauses causes = pixel.causes();
    EXPECT_EQ(causes.pixels[0].exact_critical_bias, 0.25F);
    EXPECT_EQ(causes.filters[0].exact_full_bias, 0.3125F);
    EXPECT_EQ(causes.filters[0].centre_bias, 0.25F);
}

TEST(KeptTerms, CompareAllTapsAtOnceWithTheFarthestRise)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.filter = Filter::hardware;
    pixel.verdicts(0, 0).sees(4, 4, 0.25).moved({0, 0, 0, 0});
    pixel.terms->lookup.gradients = scene::Image<scene::Vec2f>{{1, 1}, {0.03125F, -0.03125F}};
    pixel.terms->compares_at_once = true;
    EXPECT_EQ(pixel.found().exact_critical_bias, 0.125F); // r − 2(1/32 + 1/32)
}

TEST(KeptTerms, DecideAtTheBorderWhereTheyLead)
{
    OnePixel pixel{PixelClass::lit};
    pixel.settings.outside = Outside::shadowed;
    pixel.lookup.texels[0] = {8.5F, 4.5F}; // outside
    pixel.verdicts(0, 0).sees(4, 4, 0.5).moved({9, 0, 0, 0});
    EXPECT_EQ(pixel.found().exact_critical_bias, infinity);
    expect_cause(pixel.classified(), Cause::resolution, Label::edge); // P itself is on the map
}

TEST(DisplacedLookups, ArePrecisionWhereTheExactPlacesTapsAreRight)
{
    OnePixel lit{PixelClass::lit};
    lit.light.places[0] = {5.25F, 4.5F};
    lit.light.place_error = 1;
    lit.verdicts(0, 0).sees(4, 4, 0.25).sees(5, 4, 0.5);
    expect_cause(lit.classified(), Cause::precision, Label::edge);
    lit.sees(5, 4, 0.25);
    expect_cause(lit.classified(), Cause::resolution, Label::edge);

    OnePixel blocked{PixelClass::blocked};
    blocked.light.places[0] = {5.25F, 4.5F};
    blocked.light.place_error = 1;
    blocked.light.crossed = {0};
    blocked.light.blockers[0] = {7, 1, 1, 2};
    blocked.verdicts(1, 1).sees(4, 4, 0.75).sees(5, 4, 0.25);
    expect_cause(blocked.classified(), Cause::precision, Label::leak);
    blocked.light.own = {{0, 7}}; // self-shadowing is no repair
    expect_cause(blocked.classified(), Cause::resolution, Label::leak);
}

TEST(DisplacedLookups, AreNotSoughtWhereNoBorderIsNear)
{
    OnePixel pixel{PixelClass::lit};
    pixel.light.places[0] = {5.25F, 4.5F}; // only if asked for
    pixel.light.place_error = 0.25;
    pixel.verdicts(0, 0).sees(4, 4, 0.25).sees(5, 4, 0.5);
    expect_cause(pixel.classified(), Cause::resolution, Label::edge);
}

TEST(DisplacedLookups, OffTheMapAreTheBorderModes)
{
    OnePixel pixel{PixelClass::lit};
    pixel.light.places[0] = {8.25F, 4.5F};
    pixel.light.place_error = 1;
    pixel.verdicts(0, 0).sees(4, 4, 0.25);
    pixel.settings.outside = Outside::lit;
    expect_cause(pixel.classified(), Cause::precision, Label::edge);
    pixel.settings.outside = Outside::shadowed;
    expect_cause(pixel.classified(), Cause::resolution, Label::edge);
}

} // namespace
} // namespace gnomon::analysis
