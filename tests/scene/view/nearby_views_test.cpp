#include "scene/view/nearby_cameras.hpp"

#include "scene/error.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gnomon::scene {
namespace {

double degrees_between(const Vec3d& a, const Vec3d& b)
{
    const double cosine = glm::dot(glm::normalize(a), glm::normalize(b));
    return std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi;
}

TEST(NearbyCamera, IsThatOfTheFormula)
{
    CameraSettings own;
    own.eye = {0, 0, 4};
    own.target = {0, 0, 0};
    // k = 1: a = 1/2, b = 1/3, c = 1/5; cos α = 3/4, to the side of 120°.
    const CameraSettings nearby = nearby_camera(own, 1);
    const double length = 4 * std::exp2(0.2 - 0.5);
    const double sine = std::sqrt(1 - 0.75 * 0.75);
    // 1e-12: a few roundings of numbers below 4.
    EXPECT_NEAR(nearby.eye.x, length * sine * -0.5, 1e-12);
    EXPECT_NEAR(nearby.eye.y, length * sine * std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(nearby.eye.z, length * 0.75, 1e-12);
    EXPECT_EQ(nearby.target, own.target);
    EXPECT_EQ(nearby.up, own.up);
}

TEST(NearbyCamera, StaysInItsCapAndDistances)
{
    CameraSettings own;
    own.projection = Projection::orthographic;
    const double own_m = glm::length(own.eye - own.target);
    for (std::uint32_t k = 1; k <= 200; ++k) {
        const CameraSettings nearby = nearby_camera(own, k);
        const double distance_m = glm::length(nearby.eye - nearby.target);
        EXPECT_LE(degrees_between(nearby.eye - nearby.target, own.eye - own.target), 60 + 1e-9)
            << k;
        EXPECT_GE(distance_m, own_m / std::numbers::sqrt2 * (1 - 1e-12)) << k;
        EXPECT_LT(distance_m, own_m * std::numbers::sqrt2) << k;
        EXPECT_NEAR(nearby.orthographic_height_m / own.orthographic_height_m, distance_m / own_m,
                    1e-12)
            << k;
    }
}

TEST(NearbyLight, TurnsByAtMostThirtyDegrees)
{
    LightSettings directional;
    directional.direction = Vec3d{0, -2, 0};
    LightSettings spot;
    spot.type = LightType::spot;
    spot.position = Vec3d{1, 5, 2};
    spot.target = Vec3d{0, 1, 0};
    for (std::uint32_t k = 1; k <= 200; ++k) {
        EXPECT_LE(degrees_between(*nearby_light(directional, k).direction, *directional.direction),
                  30 + 1e-6)
            << k;
        const LightSettings turned = nearby_light(spot, k);
        EXPECT_EQ(turned.target, spot.target);
        EXPECT_LE(degrees_between(*turned.target - *turned.position, *spot.target - *spot.position),
                  30 + 1e-6)
            << k;
        EXPECT_NEAR(glm::length(*turned.target - *turned.position),
                    glm::length(*spot.target - *spot.position), 1e-12)
            << k;
    }
}

TEST(NearbyViews, RefuseWhatIsNoCameraOrLight)
{
    CameraSettings nowhere;
    nowhere.target = nowhere.eye;
    EXPECT_THROW((void)nearby_camera(nowhere, 1), InputError);
    EXPECT_THROW((void)nearby_light({}, 1), InputError);
}

TEST(NearbyLight, IsNoneOfAPointLight)
{
    LightSettings point;
    point.type = LightType::point;
    point.position = Vec3d{1, 5, 2};
    EXPECT_THROW((void)nearby_light(point, 1), std::invalid_argument);
}

} // namespace
} // namespace gnomon::scene
