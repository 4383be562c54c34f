#include "scene/depth/driver_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::scene {
namespace {

constexpr double u32 = 0x1p-24;

/// Depth 0.25 + x/64 + y/128 over a right triangle at (8, 8); every product below is exact.
WindowTriangle ramp()
{
    const auto depth = [](const Vec2d& p) { return 0.25 + p.x / 64 + p.y / 128; };
    const std::array<Vec2d, 3> corner{Vec2d{8, 8}, Vec2d{24, 8}, Vec2d{8, 24}};
    return {corner, {depth(corner[0]), depth(corner[1]), depth(corner[2])}};
}

TEST(DriverDepthBound, OfAFlatTriangleIsSixRoundingsOfItsDepth)
{
    WindowTriangle flat = ramp();
    flat.depth = {0.5, 0.5, 0.5};
    EXPECT_EQ(driver_depth_bound(flat, {}, 0, {9, 9}), 6 * u32 * 0.5);
    EXPECT_EQ(driver_depth_bound(flat, {8, true}, 0x1p-20, {9, 9}), 6 * u32 * 0.5 + 0x1p-20);
}

TEST(DriverDepthBound, AddsPlaneSliverEdgeAndSnapOfARamp)
{
    // z0 = 0.25 + 8/64 + 8/128 = 0.4375, slopes 1/64 and 1/128, reach 24 px both ways.
    const double plane = 6 * u32 * (0.4375 + 2 * (24.0 / 64 + 24.0 / 128));
    // Legs of 16 px, area2 = 256: Δz01 = −1/4, Δz20 = 1/8, Δ01 = (−16, 0), Δ20 = (0, 16).
    // Edges err by 2u·24 = 48u, the area by 48u·(16 + 16) = 1536u, the slopes by
    // (48u·(1/4 + 1/8) + 1536u/64)/256 and (48u·(1/4 + 1/8) + 1536u/128)/256: 72u/256 together,
    // times the distance from the farthest corner.
    const double edge_per_px = 72 * u32 / 256;
    EXPECT_EQ(driver_depth_bound(ramp(), {}, 0, {8, 8}), plane + 16 * edge_per_px);
    // Sliver, one pixel off: x 4u(1/4·16 + 1/8·0)/256 = u/16, y 4u(16·1/8 + 0·1/4)/256 = u/32.
    EXPECT_EQ(driver_depth_bound(ramp(), {}, 0, {9, 9}),
              plane + (u32 / 16 + u32 / 32) + 15 * edge_per_px);
    // Snapped corners move by half of 2^-8 px in x and y.
    EXPECT_EQ(driver_depth_bound(ramp(), {8, true}, 0, {8, 8}),
              std::ldexp(1.0 / 64 + 1.0 / 128, -9) + plane + 16 * edge_per_px);
    EXPECT_LT(driver_depth_bound(ramp(), {10, true}, 0, {8, 8}),
              driver_depth_bound(ramp(), {8, true}, 0, {8, 8}));
}

TEST(DriverDepthBound, IsInfiniteWhereRoundingCanTurnATriangleOver)
{
    WindowTriangle sliver = ramp();
    sliver.position_px[2] = {40, 8 + 0x1p-20};
    EXPECT_TRUE(std::isinf(driver_depth_bound(sliver, {}, 0, {24, 8})));
}

TEST(DriverDepthBound, IsInfiniteForATriangleWithoutArea)
{
    WindowTriangle sliver = ramp();
    sliver.position_px[2] = {40, 8};
    EXPECT_TRUE(std::isinf(driver_depth_bound(sliver, {}, 0, {9, 8})));
}

TEST(VertexDepthError, CountsTheRoundingsOfRowAndDivision)
{
    // z = 2z' + 1, w = z': at z' = 4, z/w = 9/4, S_z = 9, S_w = 4.
    Mat4f matrix{0};
    matrix[2][2] = 2;
    matrix[3][2] = 1;
    matrix[2][3] = 1;
    const double gamma4 = 4 * u32 / (1 - 4 * u32);
    const double transform = gamma4 * (9 + 2.25 * 4) / 4;
    EXPECT_DOUBLE_EQ(vertex_depth_error(matrix, {0, 0, 4}, true), transform + 2 * u32 * 2.25);
    EXPECT_DOUBLE_EQ(vertex_depth_error(matrix, {0, 0, 4}, false),
                     0.5 * transform + u32 * 2.25 + u32);
}

TEST(VertexDepthError, GrowsWithCancellation)
{
    // z = x − 1000 at x = 1000 + 1: the result is 1, its error that of 2001.
    Mat4f matrix{0};
    matrix[0][2] = 1;
    matrix[3][2] = -1000;
    matrix[3][3] = 1;
    EXPECT_GT(vertex_depth_error(matrix, {1001, 0, 0}, true), 2001 * 4 * u32);
}

TEST(VertexDepthError, IsInfiniteInTheEyesPlane)
{
    EXPECT_TRUE(std::isinf(vertex_depth_error(Mat4f{0}, {1, 2, 3}, true)));
}

} // namespace
} // namespace gnomon::scene
