#include "analysis/lookup/footprint.hpp"

#include "lookup_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::Filter;
using scene::Outside;
using testing::ElementsAre;

std::vector<std::pair<int, int>> texels_of(const std::vector<Tap>& taps)
{
    std::vector<std::pair<int, int>> texels;
    for (const Tap& tap : taps) {
        texels.emplace_back(tap.texel.x, tap.texel.y);
    }
    return texels;
}

double total_weight(const std::vector<Tap>& taps)
{
    double total = 0;
    for (const Tap& tap : taps) {
        total += tap.weight;
    }
    return total;
}

TEST(Footprint, NearestReadsTheFloor)
{
    const Footprint footprint = footprint_of(Filter::nearest, Outside::lit, 8);
    EXPECT_THAT(texels_of(footprint.taps({{3.0F, 4.99F}})), ElementsAre(std::pair{3, 4}));
}

TEST(Footprint, PcfReadsASquareAroundTheCentreTexelInEqualParts)
{
    const Footprint footprint = footprint_of(Filter::pcf3, Outside::lit, 8);
    const auto taps = footprint.taps({{3.5F, 4.5F}});
    EXPECT_THAT(texels_of(taps), ElementsAre(std::pair{2, 3}, std::pair{3, 3}, std::pair{4, 3},
                                             std::pair{2, 4}, std::pair{3, 4}, std::pair{4, 4},
                                             std::pair{2, 5}, std::pair{3, 5}, std::pair{4, 5}));
    EXPECT_EQ(total_weight(taps), 9);
}

TEST(Footprint, LinearWeighsItsFourTexelsByTheDistanceOfTheirCentres)
{
    const Footprint footprint = footprint_of(Filter::linear, Outside::lit, 8);
    const auto taps = footprint.taps({{3.75F, 4.5F}}); // ¼ texel right of a centre, level with it
    EXPECT_THAT(texels_of(taps),
                ElementsAre(std::pair{3, 4}, std::pair{4, 4}, std::pair{3, 5}, std::pair{4, 5}));
    EXPECT_EQ(taps[0].weight, 0.75);
    EXPECT_EQ(taps[1].weight, 0.25);
    EXPECT_EQ(taps[2].weight, 0);
    EXPECT_EQ(total_weight(taps), 1);
}

TEST(Footprint, TapsBeyondTheBorderAreOutsideUnlessClamped)
{
    const Footprint open = footprint_of(Filter::pcf3, Outside::shadowed, 8);
    const auto taps = open.taps({{0.5F, 7.5F}});
    EXPECT_EQ(std::ranges::count(taps, true, &Tap::is_inside), 4);
    const Footprint clamped = footprint_of(Filter::pcf3, Outside::clamp, 8);
    const auto limited = clamped.taps({{0.5F, 7.5F}});
    EXPECT_EQ(std::ranges::count(limited, true, &Tap::is_inside), 9);
    EXPECT_EQ(texels_of(limited).front(), std::pair(0, 6));
    EXPECT_EQ(texels_of(limited).back(), std::pair(1, 7));
}

TEST(Footprint, RingSurroundsTheTapsWithinTheMap)
{
    constexpr std::array<std::pair<Filter, std::size_t>, 4> sizes{
        {{Filter::nearest, 8}, {Filter::linear, 12}, {Filter::hardware, 12}, {Filter::pcf5, 24}}};
    for (const auto& [filter, size] : sizes) {
        const Footprint footprint = footprint_of(filter, Outside::lit, 64);
        std::set<std::pair<int, int>> texels;
        for (const scene::Texel& texel : footprint.ring({{30.25F, 31.75F}})) {
            texels.emplace(texel.x, texel.y);
        }
        EXPECT_EQ(texels.size(), size) << scene::filter_name(filter);
        for (const auto& tap : texels_of(footprint.taps({{30.25F, 31.75F}}))) {
            EXPECT_FALSE(texels.contains(tap)) << scene::filter_name(filter);
        }
    }
    const Footprint corner = footprint_of(Filter::nearest, Outside::lit, 64);
    EXPECT_EQ(corner.ring({{0.5F, 0.5F}}).size(), 3U);
}

/// Traits of a method that interpolates a kernel's means.
methods::LookupTraits lookup_traits_of(std::span<const float> kernel)
{
    return {.width_texels = static_cast<int>(kernel.size()) + 1,
            .weights = methods::Weights::bilinear,
            .kernel = {kernel}};
}

constexpr std::array<float, 3> gaussian{0.25F, 0.5F, 0.25F};

/// Along columns, and along rows.
void expect_weights(const std::vector<Tap>& taps, const std::array<double, 4>& columns,
                    const std::array<double, 4>& rows)
{
    ASSERT_EQ(taps.size(), 16U);
    for (std::size_t i = 0; i < taps.size(); ++i) {
        EXPECT_EQ(taps[i].weight, columns.at(i % 4) * rows.at(i / 4)) << "tap " << i;
    }
}

TEST(FootprintOfAKernel, InterpolatesTheWeightsOfTheTwoMeansAroundThePoint)
{
    const Footprint footprint{lookup_traits_of(gaussian), MapEdge::border, 8};
    // ¼ texel right of a centre: ¾ of (¼, ½, ¼, 0) and ¼ of (0, ¼, ½, ¼); level with it: the first.
    const auto taps = footprint.taps({{3.75F, 4.5F}});
    expect_weights(taps, {3 / 16.0, 7 / 16.0, 5 / 16.0, 1 / 16.0}, {0.25, 0.5, 0.25, 0});
    EXPECT_EQ(total_weight(taps), 1);
    // Halfway between centres.
    expect_weights(footprint.taps({{3.0F, 4.0F}}), {0.125, 0.375, 0.375, 0.125},
                   {0.125, 0.375, 0.375, 0.125});
}

TEST(FootprintOfAKernel, BeginsTheKernelsRadiusBeforeTheNearestCentres)
{
    const Footprint footprint{lookup_traits_of(gaussian), MapEdge::border, 8};
    EXPECT_EQ(footprint.width_texels(), 4);
    const auto texels = texels_of(footprint.taps({{3.75F, 4.5F}}));
    EXPECT_EQ(texels.front(), std::pair(2, 3));
    EXPECT_EQ(texels.back(), std::pair(5, 6));
    EXPECT_EQ(texels_of(footprint.taps({{3.25F, 4.25F}})).front(), std::pair(1, 2));
    // The point lies in texel (3, 4) both times.
    EXPECT_EQ(footprint.centre_tap({{3.75F, 4.5F}}), 5U);
    EXPECT_EQ(footprint.centre_tap({{3.25F, 4.25F}}), 10U);
}

/// The published form: bilinear samples u beside the point's base, each weighted, contribute weight
/// · (1 − fract) to the lower texel and weight · fract to the upper one.
TEST(FootprintOfAKernel, HasTheWeightsThatTheFieldsBilinearSamplesGive)
{
    const Footprint three = footprint_of(Filter::bilinear3, Outside::lit, 8);
    const Footprint five = footprint_of(Filter::bilinear5, Outside::lit, 8);
    const Footprint seven = footprint_of(Filter::bilinear7, Outside::lit, 8);
    for (const float s : {0.0F, 0.125F, 0.5F, 0.8125F}) {
        const scene::MapPoint at{
            {3.5F + s, 3.5F}}; // level with a centre: a row's weights are whole
        const auto row_of = [&](const Footprint& footprint, std::size_t row) {
            const auto taps = footprint.taps(at);
            const auto across = static_cast<std::size_t>(footprint.width_texels());
            std::vector<double> weights;
            for (std::size_t x = 0; x < across; ++x) {
                weights.push_back(taps[row * across + x].weight);
            }
            return weights;
        };
        const double u{s};
        EXPECT_THAT(row_of(three, 0), ElementsAre(1 - u, 2 - u, 1 + u, u));
        EXPECT_THAT(row_of(five, 0), ElementsAre(1 - u, 3 - 2 * u, 4 - u, 3 + u, 1 + 2 * u, u));
        EXPECT_THAT(row_of(seven, 0), ElementsAre(1 - u, 5 - 4 * u, 12 - 7 * u, 16 - 4 * u,
                                                  12 + 4 * u, 5 + 7 * u, 1 + 4 * u, u));
        EXPECT_EQ(total_weight(three.taps(at)), 16);
        EXPECT_EQ(total_weight(five.taps(at)), 144);
        EXPECT_EQ(total_weight(seven.taps(at)), 52 * 52);
    }
}

TEST(FootprintOfAKernel, KeepsItsWeightsBeyondTheBorder)
{
    const Footprint open{lookup_traits_of(gaussian), MapEdge::border, 8};
    const auto taps = open.taps({{0.5F, 0.5F}}); // around texel (0, 0)
    EXPECT_EQ(texels_of(taps).front(), std::pair(-1, -1));
    EXPECT_EQ(std::ranges::count(taps, true, &Tap::is_inside), 9);
    EXPECT_EQ(total_weight(taps), 1);
    const Footprint clamped{lookup_traits_of(gaussian), MapEdge::clamp, 8};
    const auto limited = clamped.taps({{0.5F, 0.5F}});
    EXPECT_EQ(std::ranges::count(limited, true, &Tap::is_inside), 16);
    EXPECT_EQ(texels_of(limited).front(), std::pair(0, 0));
    expect_weights(limited, {0.25, 0.5, 0.25, 0}, {0.25, 0.5, 0.25, 0});
}

TEST(FootprintOfAKernel, HasItsRingAroundAllTaps)
{
    const Footprint footprint{lookup_traits_of(gaussian), MapEdge::border, 64};
    std::set<std::pair<int, int>> texels;
    for (const scene::Texel& texel : footprint.ring({{30.25F, 31.75F}})) {
        texels.emplace(texel.x, texel.y);
    }
    EXPECT_EQ(texels.size(), 20U); // 6 × 6 but 4 × 4
    EXPECT_EQ(*texels.begin(), std::pair(27, 29));
    EXPECT_EQ(*texels.rbegin(), std::pair(32, 34));
    for (const auto& tap : texels_of(footprint.taps({{30.25F, 31.75F}}))) {
        EXPECT_FALSE(texels.contains(tap));
    }
    EXPECT_EQ(footprint.ring({{0.5F, 0.5F}}).size(), 7U) << "texels 3 of four columns and rows";
}

TEST(FootprintOfAKernel, OfOneTexelIsThatOfAnInterpolatedMap)
{
    constexpr std::array<float, 1> one{1.0F};
    const Footprint footprint{lookup_traits_of(one), MapEdge::border, 8};
    const Footprint linear = footprint_of(Filter::linear, Outside::lit, 8);
    for (const scene::Vec2f& point : {scene::Vec2f{3.75F, 4.5F}, {0.25F, 7.9375F}, {5.1F, 2.7F}}) {
        const auto taps = footprint.taps({point});
        const auto expected = linear.taps({point});
        EXPECT_EQ(texels_of(taps), texels_of(expected));
        for (std::size_t i = 0; i < taps.size(); ++i) {
            EXPECT_EQ(taps[i].weight, expected[i].weight) << "tap " << i;
        }
    }
}

TEST(FootprintOfAKernel, SumsToOneUpToTheKernelsRounding)
{
    constexpr std::array<float, 9> box{1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F,
                                       1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F};
    const Footprint footprint{lookup_traits_of(box), MapEdge::border, 64};
    const auto taps = footprint.taps({{30.3F, 31.7F}});
    EXPECT_EQ(taps.size(), methods::most_taps);
    // Each weight is off by at most half an ulp, 2^-28, since float32 weights are at least 1/16. A
    // line's sum is off by 9 · 2^-28, and the product of two by twice that. Sums of doubles round
    // far less.
    EXPECT_NEAR(total_weight(taps), 1, 2.1 * 9 * 0x1p-28);
}

/// Traits of a method with taps at these places.
methods::LookupTraits lookup_traits_of(std::span<const scene::Vec2f> places,
                                       std::span<const float> weights = {})
{
    return {.width_texels = 5,
            .weights = weights.empty() ? methods::Weights::equal : methods::Weights::of_taps,
            .kernel = {},
            .taps = {.places = places, .weights = weights, .radius = 2}};
}

const std::array<scene::Vec2f, 3> three_places{
    {scene::Vec2f{0, 0}, scene::Vec2f{1, 0}, scene::Vec2f{0.5F, -1}}};

TEST(FootprintOfScatteredTaps, ReadsTheTexelsThatHoldThem)
{
    const Footprint footprint{lookup_traits_of(three_places), MapEdge::border, 8};
    EXPECT_EQ(footprint.tap_count(), 3U);
    // Radius 2, not turned: at (3.75, 4.5), (5.75, 4.5) and (4.75, 2.5).
    const scene::MapPoint straight{{3.75F, 4.5F}, 0, {2, 0}};
    EXPECT_THAT(texels_of(footprint.taps(straight)),
                ElementsAre(std::pair{3, 4}, std::pair{5, 4}, std::pair{4, 2}));
    EXPECT_EQ(total_weight(footprint.taps(straight)), 3);
    // Turned by a quarter: (0, 2) and, for (x, y) becomes (−y, x), (2, 1) from the middle.
    const scene::MapPoint turned{{3.75F, 4.5F}, 0, {0, 2}};
    EXPECT_THAT(texels_of(footprint.taps(turned)),
                ElementsAre(std::pair{3, 4}, std::pair{3, 6}, std::pair{5, 5}));
    EXPECT_EQ(footprint.centre_tap(straight), 0U);
    EXPECT_EQ(footprint.first_tap(straight), (scene::Texel{3, 4, 0}));
    EXPECT_FALSE(footprint.first_if_on_map(straight).has_value());
}

TEST(FootprintOfScatteredTaps, WeighsThemByTheirOwnWeights)
{
    constexpr std::array<float, 3> weights{0.5F, 0.375F, 0.125F};
    const Footprint footprint{lookup_traits_of(three_places, weights), MapEdge::border, 8};
    const auto taps = footprint.taps({{3.75F, 4.5F}, 0, {2, 0}});
    EXPECT_EQ(taps[0].weight, 0.5);
    EXPECT_EQ(taps[1].weight, 0.375);
    EXPECT_EQ(taps[2].weight, 0.125);
}

TEST(FootprintOfScatteredTaps, EndsAtTheBorderUnlessClamped)
{
    const scene::MapPoint corner{{6.5F, 0.5F}, 0, {2, 0}}; // taps at (6, 0), (8, 0), (7, −2)
    const auto open = Footprint{lookup_traits_of(three_places), MapEdge::border, 8}.taps(corner);
    EXPECT_EQ(std::ranges::count(open, true, &Tap::is_inside), 1);
    const auto clamped = Footprint{lookup_traits_of(three_places), MapEdge::clamp, 8}.taps(corner);
    EXPECT_THAT(texels_of(clamped), ElementsAre(std::pair{6, 0}, std::pair{7, 0}, std::pair{7, 0}));
}

TEST(FootprintOfScatteredTaps, HasARingOfWhatLiesNextToThem)
{
    const Footprint footprint{lookup_traits_of(three_places), MapEdge::border, 64};
    // All three in one texel: the eight around it.
    EXPECT_EQ(footprint.ring({{30.5F, 30.5F}, 0, {0.25F, 0}}).size(), 8U);
    // The taps are (30, 30), (32, 30) and (31, 28): 5 × 3 around the first two, 3 × 3 around the
    // third, one row of which is counted already, minus the three taps.
    EXPECT_EQ(footprint.ring({{30.5F, 30.5F}, 0, {2, 0}}).size(), 15U + 6U - 3U);
}

TEST(Footprint, PointsThatCannotBeCountedAreOutside)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const Footprint footprint = footprint_of(Filter::pcf9, Outside::lit, 16384);
    for (const float x : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, 3e38F}) {
        const auto taps = footprint.taps({{x, 5.0F}});
        EXPECT_TRUE(std::ranges::none_of(taps, &Tap::is_inside)) << x;
        EXPECT_FALSE(footprint.is_inside({{x, 5.0F}})) << x;
    }
}

} // namespace
} // namespace gnomon::analysis
