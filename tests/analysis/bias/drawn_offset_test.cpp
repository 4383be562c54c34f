#include "analysis/bias/drawn_offset.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gnomon::analysis {
namespace {

constexpr int texels_across = 64;
constexpr scene::DepthFormat offset_d16{scene::DepthFormat::Kind::d16, 16};

/// A map from -1 to 1 across, whose matrix takes z from -1 to 1 to depth, 8 m deep.
scene::LightFrustum plain_map()
{
    scene::LightFrustum map;
    map.near_m = 2;
    map.far_m = 10;
    return map;
}

/// z = per_x · x + per_y · y
scene::TriangleScene sloping_triangle(float per_x, float per_y)
{
    scene::TriangleScene scene;
    scene.vertices = {{0, 0, 0}, {1, 0, per_x}, {0, 1, per_y}};
    scene.triangles = {{0, 1, 2}};
    return scene;
}

/// Pixels in a row that show the triangle at these light distances.
struct SeenTriangle {
    scene::TriangleScene triangles;
    std::vector<scene::LightFrustum> maps;
    scene::Image<std::uint32_t> receivers;
    scene::Image<scene::PixelClass> classes;
    scene::Image<float> light_distance_m;
    scene::MapIndices map_indices;
    scene::DepthFormat format = offset_d16;
    std::vector<scene::OffsetUnit> units{{0.5, 0x1p-16}};

    SeenTriangle(scene::TriangleScene scene, const scene::LightFrustum& map,
                 const std::vector<float>& distances_m)
        : triangles{std::move(scene)},
          maps{map},
          receivers{{static_cast<int>(distances_m.size()), 1}, 0},
          classes{receivers.size(), scene::PixelClass::lit},
          light_distance_m{receivers.size()}
    {
        for (std::size_t i = 0; i < distances_m.size(); ++i) {
            light_distance_m[i] = distances_m[i];
        }
    }

    [[nodiscard]] std::optional<DrawnOffset> find(const methods::PolygonOffset& offset) const
    {
        return find_drawn_offset(offset, {triangles,
                                          receivers,
                                          classes,
                                          light_distance_m,
                                          {maps, map_indices, texels_across},
                                          format,
                                          units});
    }
};

TEST(DepthGradient, IsThePlanesSlopePerTexel)
{
    // The map is 2 across with 64 texels; a unit of z is half a depth unit.
    const scene::Vec2d gradient =
        depth_gradient(plain_map(), sloping_triangle(0.25F, -0.5F).corners(0), texels_across);
    EXPECT_DOUBLE_EQ(gradient.x, 0.25 / 64);
    EXPECT_DOUBLE_EQ(gradient.y, -0.5 / 64);
    scene::LightFrustum whole_range = plain_map();
    whole_range.clip_range = scene::ClipRange::zero_to_one;
    const scene::Vec2d twice =
        depth_gradient(whole_range, sloping_triangle(0.25F, -0.5F).corners(0), texels_across);
    EXPECT_DOUBLE_EQ(twice.x, 0.5 / 64);
}

// A plane stays a plane in a map, even in perspective, so its depth gradient is constant. Each
// double rounds a few times to 2^-53.
TEST(DepthGradient, IsTheDifferenceOfProjectedDepthsInPerspective)
{
    scene::LightFrustum map = plain_map();
    map.light_clip_from_world = scene::Mat4f{0};
    map.light_clip_from_world[0][0] = 1;
    map.light_clip_from_world[1][1] = 1;
    map.light_clip_from_world[2][2] = 1.5F; // of near 2 and far 10, along +z
    map.light_clip_from_world[2][3] = 1;
    map.light_clip_from_world[3][2] = -5;
    const scene::TriangleScene scene = [] {
        scene::TriangleScene corners = sloping_triangle(0.25F, -0.5F);
        for (scene::Vec3f& vertex : corners.vertices) {
            vertex.z += 4;
        }
        return corners;
    }();
    const scene::Vec2d gradient = depth_gradient(map, scene.corners(0), texels_across);
    std::array<scene::Vec3d, 3> window{};
    for (std::size_t i = 0; i < 3; ++i) {
        const scene::Vec4d clip = scene::Mat4d{map.light_clip_from_world} *
                                  scene::Vec4d{scene::Vec3d{scene.corners(0)[i]}, 1};
        window[i] = scene::Vec3d{clip} / clip.w * 0.5 + 0.5;
        window[i].x *= texels_across;
        window[i].y *= texels_across;
    }
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
        const scene::Vec3d step = window[i] - window[0];
        EXPECT_NEAR(gradient.x * step.x + gradient.y * step.y, step.z, 0x1p-48);
    }
}

TEST(DrawnOffset, IsFactorTimesTheLargerChangeAndUnitsTimesR)
{
    const SeenTriangle seen{sloping_triangle(0.25F, -0.5F), plain_map(), {4}};
    const auto drawn = seen.find({2, 8, 0});
    ASSERT_TRUE(drawn);
    EXPECT_EQ(drawn->r.median, 0x1p-16F);
    EXPECT_EQ(drawn->of_factor.depth.median, 1.0F / 64);
    EXPECT_EQ(drawn->of_units.depth.median, 0x1p-13F);
    EXPECT_EQ(drawn->whole.depth.median, 1.0F / 64 + 0x1p-13F);
    EXPECT_EQ(drawn->of_factor.metres.median, 8.0F / 64);
    EXPECT_EQ(drawn->of_factor.texels.median, 4.0F); // of 1/32 m
}

TEST(DrawnOffset, HasAsManyStepsAsWereMeasuredElsewhereInFloats)
{
    SeenTriangle seen{sloping_triangle(0, 0), plain_map(), {3}}; // depth 1/8
    seen.format = scene::float_depth_format;
    seen.units = {{0.75, 0x1p-24}};
    const auto drawn = seen.find({0, 1, 0});
    ASSERT_TRUE(drawn);
    EXPECT_EQ(drawn->r.median, 0x1p-26F);
}

TEST(DrawnOffset, IsLimitedByClampAndByWhatDepthsThereAre)
{
    const SeenTriangle seen{sloping_triangle(0, 0.5F), plain_map(), {4, 9, 10}};
    const auto clamped = seen.find({100, 0, 0.125F});
    ASSERT_TRUE(clamped);
    EXPECT_EQ(clamped->whole.depth.max, 0.125F);
    EXPECT_EQ(clamped->whole.depth.min, 0.0F); // at the far plane
    const auto towards = seen.find({-100, 0, -0.125F});
    ASSERT_TRUE(towards);
    EXPECT_EQ(towards->whole.depth.min, -0.125F);
    const auto endless = seen.find({1e6F, 0, 0});
    ASSERT_TRUE(endless);
    EXPECT_EQ(endless->whole.metres.max, 6.0F); // from 4 m to far
}

TEST(DrawnOffset, CountsAwayFromTheLightInAReversedMapToo)
{
    scene::LightFrustum map = plain_map();
    map.reversed = true;
    map.clip_range = scene::ClipRange::zero_to_one;
    const SeenTriangle seen{sloping_triangle(0, 0.5F), map, {4}};
    const auto drawn = seen.find({-1, 0, 0});
    ASSERT_TRUE(drawn);
    EXPECT_EQ(drawn->whole.depth.median, 1.0F / 64);
    EXPECT_EQ(drawn->whole.metres.median, 8.0F / 64);
}

TEST(DrawnOffset, IsOfScoredPixelsAlone)
{
    SeenTriangle seen{sloping_triangle(0, 0.5F), plain_map(), {4, 5}};
    seen.classes[1] = scene::PixelClass::attached;
    const auto drawn = seen.find({1, 0, 0});
    ASSERT_TRUE(drawn);
    EXPECT_EQ(drawn->whole.depth.count, 1U);
    seen.classes[0] = scene::PixelClass::background;
    EXPECT_FALSE(seen.find({1, 0, 0}));
}

TEST(DrawnOffset, NeedsAUnit)
{
    SeenTriangle seen{sloping_triangle(0, 0), plain_map(), {4}};
    seen.units.clear();
    EXPECT_THROW((void)seen.find({1, 0, 0}), std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
