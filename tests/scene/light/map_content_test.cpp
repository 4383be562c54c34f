// What maps store: the rows of contents.

#include "scene/light/frustum.hpp"
#include "scene/light/map_content.hpp"

#include <gtest/gtest.h>

namespace gnomon::scene {
namespace {

TEST(MapContents, AreKnownByTheirNames)
{
    for (const MapContentTraits& traits : map_contents()) {
        EXPECT_EQ(map_content_from_name(map_content_name(traits.content)), traits.content);
    }
    EXPECT_EQ(map_content_from_name("depths"), std::nullopt);
}

TEST(MapContents, StoreWhatAShaderWritesEvenlyUpToFar)
{
    LightFrustum spot;
    spot.projection = Projection::perspective;
    spot.near_m = 2;
    spot.far_m = 10;
    spot.reversed = true;
    for (const MapContentTraits& traits : map_contents()) {
        spot.content = traits.content;
        const DepthRange stored = spot.stored_range();
        EXPECT_EQ(stored.projection == Projection::perspective, traits.is_gl_depth());
        EXPECT_EQ(stored.reversed, traits.is_gl_depth());
        EXPECT_EQ(stored.near_m, traits.from_near ? 2 : 0);
        EXPECT_EQ(stored.far_m, 10);
    }
}

TEST(MapContents, ReachFartherThanTheirLightDistanceAlongRaysAlone)
{
    LightFrustum spot;
    spot.right_side = 2;
    spot.top = 2;
    for (const MapContentTraits& traits : map_contents()) {
        spot.content = traits.content;
        // √(2² + 2² + 1²)
        EXPECT_EQ(spot.largest_per_light_distance(), traits.measure == Measure::ray ? 3 : 1);
    }
}

} // namespace
} // namespace gnomon::scene
