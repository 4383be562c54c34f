#include "analysis/bias/bias_units.hpp"

#include "analysis/lookup/bias_order.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::DepthFormat;
using scene::PixelClass;

constexpr double endless_m = std::numeric_limits<double>::infinity();

scene::LightFrustum directional()
{
    scene::LightFrustum frustum; // sides from -1 to 1
    frustum.near_m = 2;
    frustum.far_m = 10;
    return frustum;
}

/// The example in the lesson on depth precision: n = 4, f = 50.
scene::LightFrustum spot(bool reversed = false)
{
    scene::LightFrustum frustum;
    frustum.projection = scene::Projection::perspective;
    frustum.near_m = 4;
    frustum.far_m = 50;
    frustum.reversed = reversed;
    return frustum;
}

double depth_at(const scene::LightFrustum& frustum, double light_distance_m)
{
    const double depth =
        (1 / frustum.near_m - 1 / light_distance_m) / (1 / frustum.near_m - 1 / frustum.far_m);
    return frustum.reversed ? 1 - depth : depth;
}

TEST(BiasLength, IsProportionalForADirectionalLight)
{
    EXPECT_EQ(bias_length_m(directional(), 0.25, 5.0), 2.0);
    EXPECT_EQ(bias_length_m(directional(), -0.25, 5.0), -2.0);
    EXPECT_EQ(depth_per_metre(directional(), 5.0), 0.125);
}

TEST(BiasLength, IsTheWayThatTheBiasMovesASpotsReceiver)
{
    for (const bool reversed : {false, true}) {
        const scene::LightFrustum frustum = spot(reversed);
        for (const double from_m : {5.0, 20.0, 49.0}) {
            for (const double to_m : {4.5, 20.0, 48.0}) {
                const double sign = reversed ? -1 : 1;
                const double bias = sign * (depth_at(frustum, from_m) - depth_at(frustum, to_m));
                // Depths carry 2^-53, which ζ²/(n) amplifies to below 50²/4 · 4 · 2^-53.
                EXPECT_NEAR(bias_length_m(frustum, bias, from_m), from_m - to_m, 1e-12);
            }
        }
    }
}

TEST(BiasOfLength, IsTheInverse)
{
    EXPECT_EQ(bias_of_length(directional(), 2.0, 5.0), 0.25);
    for (const double bias : {1e-6, 1e-3, 0.1}) {
        for (const double light_distance_m : {5.0, 20.0, 49.0}) {
            const double length_m = bias_length_m(spot(), bias, light_distance_m);
            // Relative: ζ − length loses at most a few bits here.
            EXPECT_NEAR(bias_of_length(spot(), length_m, light_distance_m) / bias, 1, 1e-12);
        }
    }
    EXPECT_EQ(bias_of_length(spot(), 5, 5), std::numeric_limits<double>::infinity());
}

TEST(BiasLength, HasTheSlopeOfDepth)
{
    const double step_m = 1e-5;
    const double slope =
        (depth_at(spot(), 20 + step_m) - depth_at(spot(), 20 - step_m)) / (2 * step_m);
    // The central difference is off by step²/ζ², relatively, and by 2^-53 / (slope · step).
    EXPECT_NEAR(depth_per_metre(spot(), 20) / slope, 1.0, 1e-8);
}

TEST(BiasLength, IsInfiniteBeyondEveryDistance)
{
    // A·b·ζ = -1 at the bias that brings the receiver's 1/ζ to 0; A = 0.23.
    EXPECT_EQ(bias_length_m(spot(), -1.0, 1 / 0.23), -endless_m);
    EXPECT_EQ(bias_length_m(spot(), -1.0, 20), -endless_m);
    for (const auto& frustum : {spot(), directional()}) {
        EXPECT_EQ(bias_length_m(frustum, endless_m, 5), endless_m);
        EXPECT_EQ(bias_length_m(frustum, -endless_m, 5), -endless_m);
    }
}

TEST(DepthStep, IsTheDifferenceOfNeighbouringDepths)
{
    EXPECT_EQ(depth_step({DepthFormat::Kind::unorm, 8}, 0.3F), 1.0 / 255);
    EXPECT_EQ(depth_step({DepthFormat::Kind::d16, 16}, 0.3F), 1.0 / 65535);
    EXPECT_EQ(depth_step({DepthFormat::Kind::d32, 32}, 0.3F), 1.0 / 4294967295.0);
    const DepthFormat d32f{DepthFormat::Kind::d32f, 32};
    for (const float depth : {1.0F, 0.5F, 0.75F, 0x1p-20F}) {
        EXPECT_EQ(depth_step(d32f, depth), double{std::nextafter(depth, 2.0F)} - double{depth});
    }
    EXPECT_EQ(depth_step(d32f, 0.0F), 0x1p-149);
    const DepthFormat r16f{DepthFormat::Kind::r16f, 16};
    EXPECT_EQ(depth_step(r16f, 1.0F), 0x1p-10);
    EXPECT_EQ(depth_step(r16f, 0.75F), 0x1p-11);
    EXPECT_EQ(depth_step(r16f, 0.0F), 0x1p-24);
}

TEST(DepthStep, OfPackedBytesIsTheFirstOnes)
{
    for (const float depth : {0.0F, 0.3F, 1.0F}) {
        EXPECT_EQ(depth_step({DepthFormat::Kind::rgba8, 32}, depth), 1.0 / 255);
    }
}

TEST(BiasMap, HoldsWhatLitPixelsNeedAndBlockedPixelsAllow)
{
    constexpr scene::ImageSize size{3, 1};
    scene::Image<float> criticals{size, 0.25F};
    scene::Image<PixelClass> classes{size, PixelClass::lit};
    classes[1] = PixelClass::blocked;
    classes[2] = PixelClass::attached;
    const scene::LookupLayers lookup{scene::Image<scene::LookupSample>{size, {0.5F, 0, 0, 0}}};
    const scene::Image<float> light_distance_m{size, 6.0F};
    const DepthFormat d32f{DepthFormat::Kind::d32f, 32};
    const std::array maps{directional()};
    const BiasMap map =
        map_biases({criticals, classes, lookup, light_distance_m, {maps, lookup.maps, 4}, d32f});
    EXPECT_EQ(map.depth[0], 0.25F);
    EXPECT_EQ(map.metres[0], 2.0F);
    EXPECT_EQ(map.texels[0], 4.0F); // texels of half a metre
    EXPECT_EQ(map.steps[0], 0x1p22F);
    EXPECT_EQ(map.depth[1], previous_bias(0.25F));
    EXPECT_LT(map.metres[1], 2.0F);
    EXPECT_TRUE(std::isnan(map.depth[2]) && std::isnan(map.metres[2]) &&
                std::isnan(map.texels[2]) && std::isnan(map.steps[2]));
}

TEST(BiasMap, KeepsInfinities)
{
    constexpr scene::ImageSize size{4, 1};
    constexpr auto inf = static_cast<float>(endless_m);
    scene::Image<float> criticals{size, inf};
    criticals[1] = criticals[3] = -inf;
    scene::Image<PixelClass> classes{size, PixelClass::lit};
    classes[2] = classes[3] = PixelClass::blocked;
    const scene::LookupLayers lookup{scene::Image<scene::LookupSample>{size, {0.5F, 0, 0, 0}}};
    const scene::Image<float> light_distance_m{size, 6.0F};
    const std::array maps{spot()};
    const BiasMap map =
        map_biases({criticals, classes, lookup, light_distance_m, {maps, lookup.maps, 4}, {}});
    for (const auto* image : {&map.depth, &map.metres, &map.texels, &map.steps}) {
        EXPECT_EQ((*image)[0], inf);
        EXPECT_EQ((*image)[1], -inf);
        EXPECT_EQ((*image)[2], inf);
        EXPECT_EQ((*image)[3], -inf);
    }
}

TEST(BiasMap, RejectsImagesOfDifferentSize)
{
    const scene::Image<float> criticals{{2, 1}};
    const scene::Image<PixelClass> classes{{1, 1}};
    const scene::LookupLayers lookup{scene::Image<scene::LookupSample>{{1, 1}}};
    const scene::Image<float> light_distance_m{{1, 1}};
    const std::array maps{spot()};
    EXPECT_THROW((void)map_biases(
                     {criticals, classes, lookup, light_distance_m, {maps, lookup.maps, 4}, {}}),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
