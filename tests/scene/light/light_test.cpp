#include "scene/light/light.hpp"

#include "scene/error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::scene {
namespace {

LightSettings empty_spot()
{
    LightSettings settings;
    settings.type = LightType::spot;
    return settings;
}

TEST(RoundedToFloat32, RoundsEveryComponent)
{
    for (const double value : {0.1, -0.4, 1.0 / 3, 1e15 / 7, 1.0}) {
        const double expected = std::nextafter(static_cast<float>(value), value > 0 ? 2.0F : -2.0F);
        const Vec3d rounded = rounded_to_float32({value, 2 * value, -value});
        // The nearest float32 is less than one float32 step away, and is a float32.
        EXPECT_LE(std::abs(rounded.x - value), std::abs(expected - rounded.x)) << value;
        for (int axis = 0; axis < 3; ++axis) {
            volatile float stored = static_cast<float>(rounded[axis]);
            EXPECT_EQ(double{stored}, rounded[axis]) << value << " axis " << axis;
        }
        EXPECT_EQ(rounded.z, -rounded.x);
        EXPECT_EQ(rounded.y, 2 * rounded.x);
    }
}

TEST(Light, KeepsADirectionUnnormalisedInFloat32)
{
    LightSettings settings;
    settings.direction = Vec3d{-0.4, -2, 0.1};
    const Light light = make_light(settings);
    EXPECT_EQ(light.direction, (Vec3d{-0x1.99999ap-2, -2, 0x1.99999ap-4}));
}

TEST(Light, TakesADirectionFromPositionAndTarget)
{
    LightSettings settings;
    settings.position = Vec3d{1, 4, 1};
    settings.target = Vec3d{0, 0, 1};
    EXPECT_EQ(make_light(settings).direction, (Vec3d{-1, -4, 0}));
}

TEST(Light, OfASpotHasAxisAndCone)
{
    LightSettings settings = empty_spot();
    settings.cone_deg = 120;
    settings.position = Vec3d{0, 4, 0};
    settings.target = Vec3d{0, 1, 0};
    const Light light = make_light(settings);
    EXPECT_EQ(light.direction, (Vec3d{0, -3, 0}));
    EXPECT_EQ(light.cos_half_cone, std::cos(60 * (M_PI / 180)));
}

TEST(Light, OfAPointHasNoDirection)
{
    LightSettings settings;
    settings.type = LightType::point;
    settings.position = Vec3d{1, 2, 3};
    // Exact predicates test the scale of every light's direction, so an unused one must be 0.
    EXPECT_EQ(make_light(settings).direction, Vec3d{0.0});
}

TEST(Light, RefusesWhatIsMissingOrZero)
{
    EXPECT_THROW((void)make_light({}), InputError);
    LightSettings zero;
    zero.direction = Vec3d{1e-60, 0, 0}; // zero in float32
    EXPECT_THROW((void)make_light(zero), InputError);
    LightSettings spot = empty_spot();
    spot.position = Vec3d{1, 2, 3};
    EXPECT_THROW((void)make_light(spot), InputError);
    spot.target = spot.position;
    EXPECT_THROW((void)make_light(spot), InputError);
}

} // namespace
} // namespace gnomon::scene
