#include "analysis/lookup/footprint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

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
    const Footprint footprint{{Filter::nearest, Outside::lit}, 8};
    EXPECT_THAT(texels_of(footprint.taps({3.0F, 4.99F})), ElementsAre(std::pair{3, 4}));
}

TEST(Footprint, PcfReadsASquareAroundTheCentreTexelInEqualParts)
{
    const Footprint footprint{{Filter::pcf3, Outside::lit}, 8};
    const auto taps = footprint.taps({3.5F, 4.5F});
    EXPECT_THAT(texels_of(taps), ElementsAre(std::pair{2, 3}, std::pair{3, 3}, std::pair{4, 3},
                                             std::pair{2, 4}, std::pair{3, 4}, std::pair{4, 4},
                                             std::pair{2, 5}, std::pair{3, 5}, std::pair{4, 5}));
    EXPECT_EQ(total_weight(taps), 9);
}

TEST(Footprint, LinearWeighsItsFourTexelsByTheDistanceOfTheirCentres)
{
    const Footprint footprint{{Filter::linear, Outside::lit}, 8};
    const auto taps = footprint.taps({3.75F, 4.5F}); // ¼ texel right of a centre, level with it
    EXPECT_THAT(texels_of(taps),
                ElementsAre(std::pair{3, 4}, std::pair{4, 4}, std::pair{3, 5}, std::pair{4, 5}));
    EXPECT_EQ(taps[0].weight, 0.75);
    EXPECT_EQ(taps[1].weight, 0.25);
    EXPECT_EQ(taps[2].weight, 0);
    EXPECT_EQ(total_weight(taps), 1);
}

TEST(Footprint, TapsBeyondTheBorderAreOutsideUnlessClamped)
{
    const Footprint open{{Filter::pcf3, Outside::shadowed}, 8};
    const auto taps = open.taps({0.5F, 7.5F});
    EXPECT_EQ(std::ranges::count(taps, true, &Tap::is_inside), 4);
    const Footprint clamped{{Filter::pcf3, Outside::clamp}, 8};
    const auto limited = clamped.taps({0.5F, 7.5F});
    EXPECT_EQ(std::ranges::count(limited, true, &Tap::is_inside), 9);
    EXPECT_EQ(texels_of(limited).front(), std::pair(0, 6));
    EXPECT_EQ(texels_of(limited).back(), std::pair(1, 7));
}

TEST(Footprint, RingSurroundsTheTapsWithinTheMap)
{
    constexpr std::array<std::pair<Filter, std::size_t>, 4> sizes{
        {{Filter::nearest, 8}, {Filter::linear, 12}, {Filter::hardware, 12}, {Filter::pcf5, 24}}};
    for (const auto& [filter, size] : sizes) {
        const Footprint footprint{{filter, Outside::lit}, 64};
        std::set<std::pair<int, int>> texels;
        for (const scene::Texel& texel : footprint.ring({30.25F, 31.75F})) {
            texels.emplace(texel.x, texel.y);
        }
        EXPECT_EQ(texels.size(), size) << scene::filter_name(filter);
        for (const auto& tap : texels_of(footprint.taps({30.25F, 31.75F}))) {
            EXPECT_FALSE(texels.contains(tap)) << scene::filter_name(filter);
        }
    }
    const Footprint corner{{Filter::nearest, Outside::lit}, 64};
    EXPECT_EQ(corner.ring({0.5F, 0.5F}).size(), 3U);
}

TEST(Footprint, PointsThatCannotBeCountedAreOutside)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const Footprint footprint{{Filter::pcf9, Outside::lit}, 16384};
    for (const float x : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, 3e38F}) {
        const auto taps = footprint.taps({x, 5.0F});
        EXPECT_TRUE(std::ranges::none_of(taps, &Tap::is_inside)) << x;
        EXPECT_FALSE(footprint.is_inside({x, 5.0F})) << x;
    }
}

} // namespace
} // namespace gnomon::analysis
