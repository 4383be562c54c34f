#include "scene/light/map_choice.hpp"

#include "scene/view/view.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

namespace gnomon::scene {
namespace {

/// x and y from −1 to 1 are clip coordinates, too, and z.
LightFrustum cube_of(const Vec3f& centre, ClipRange range = ClipRange::minus_one_to_one)
{
    LightFrustum map;
    map.clip_range = range;
    map.light_clip_from_world[3] = {-centre, 1};
    return map;
}

TEST(AMap, ContainsFromItsLowerEdgesToBeforeItsUpperOnes)
{
    const LightFrustum map = cube_of({0, 0, 0});
    constexpr float below_one = 1 - 0x1p-23F;
    EXPECT_TRUE(contains(map, {0, 0, 0, 1}));
    EXPECT_TRUE(contains(map, {-1, -1, 0, 1}));
    EXPECT_TRUE(contains(map, {below_one, below_one, 0, 1}));
    EXPECT_FALSE(contains(map, {1, 0, 0, 1}));
    EXPECT_FALSE(contains(map, {0, 1, 0, 1}));
    EXPECT_FALSE(contains(map, {-1 - 0x1p-22F, 0, 0, 1}));
    // The lookup's coordinate rounds to the map's edge, which is not a texel of it.
    EXPECT_FALSE(contains(map, {1 - 0x1p-24F, 0, 0, 1}));
}

TEST(AMap, ContainsItsNearAndFarPlanes)
{
    const LightFrustum map = cube_of({0, 0, 0});
    EXPECT_TRUE(contains(map, {0, 0, -1, 1}));
    EXPECT_TRUE(contains(map, {0, 0, 1, 1}));
    EXPECT_FALSE(contains(map, {0, 0, -1.5F, 1}));
    EXPECT_FALSE(contains(map, {0, 0, 1.5F, 1}));
    const LightFrustum reversed = cube_of({0, 0, 0}, ClipRange::zero_to_one);
    EXPECT_TRUE(contains(reversed, {0, 0, 0, 1}));
    EXPECT_FALSE(contains(reversed, {0, 0, -0.5F, 1}));
}

TEST(AMap, ContainsNothingBehindItsLight)
{
    const LightFrustum map = cube_of({0, 0, 0});
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(contains(map, {0, 0, 0, 0}));
    EXPECT_FALSE(contains(map, {0, 0, 0, -1}));
    EXPECT_FALSE(contains(map, {nan, 0, 0, 1}));
    EXPECT_FALSE(contains(map, {0, 0, nan, 1}));
}

TEST(TheChosenMap, IsTheFirstThatContainsThePoint)
{
    const std::vector<LightFrustum> maps{cube_of({0, 0, 0}), cube_of({1, 0, 0}),
                                         cube_of({5, 0, 0})};
    EXPECT_EQ(chosen_map(maps, MapChoice::containing, {}, {0, 0, 0}), 0U);
    EXPECT_EQ(chosen_map(maps, MapChoice::containing, {}, {1, 0, 0}), 1U);
    EXPECT_EQ(chosen_map(maps, MapChoice::containing, {}, {4.5F, 0, 0}), 2U);
    EXPECT_EQ(chosen_map(maps, MapChoice::containing, {}, {-7, 0, 0}), 2U); // none: the last
}

TEST(AViewWithoutMaps, HasNoFirstOne)
{
    EXPECT_THROW((void)View{}.first_map(), std::logic_error);
}

} // namespace
} // namespace gnomon::scene
