#include "analysis/metrics/peter_panning_gaps.hpp"

#include "fake_light.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::analysis {
namespace {

/// Two pixels before a wall at ζ = 4, which the light sees from where the camera stands.
struct Wall {
    scene::TriangleScene triangles;
    scene::View view;
    scene::Image<std::uint32_t> receivers{{2, 1}, 0};

    Wall()
    {
        scene::SceneBuilder builder;
        const std::vector<scene::Vec3d> corners{{-9, -9, -4}, {9, -9, -4}, {0, 9, -4}};
        const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}};
        builder.add("wall", corners, triangle);
        triangles = builder.take();
        view.image = {2, 1};
        view.camera.projection = scene::Projection::orthographic;
        view.camera.eye = {0, 0, 0};
        view.camera.forward = {0, 0, -1};
        view.camera.right = {1, 0, 0};
        view.camera.up = {0, 1, 0};
        view.maps.resize(1);
        scene::LightFrustum& map = view.maps.front();
        map.projection = scene::Projection::perspective;
        map.origin = {0, 0, 0};
        map.forward = {0, 0, -1};
    }
    [[nodiscard]] ReceiverGeometry geometry() const { return {triangles, view, receivers}; }
};

TEST(GapsOfPixels, AreInMetresAndInTexelsAtTheReceiver)
{
    FakeLight light;
    light.blockers[0] = {3, 0.5, 2, 4};
    light.blockers[1] = {3, 1.5, 2, 4};
    const Wall wall;
    const std::vector<std::size_t> pixels{0, 1};
    BlockerGapCache known{wall.view.image};
    known.find(light, pixels);
    const auto gaps = gaps_of_pixels(known, pixels, wall.geometry(), {wall.view.maps, {}, 16});
    ASSERT_EQ(gaps.size(), 2U);
    // A texel is 2·4/16 = 0.5 m wide there.
    EXPECT_EQ(gaps[0].metres, 0.5F);
    EXPECT_EQ(gaps[0].texels, 1.0F);
    EXPECT_EQ(gaps[1].metres, 1.5F);
    EXPECT_EQ(gaps[1].texels, 3.0F);
    EXPECT_TRUE(gaps_of_pixels(known, {}, wall.geometry(), {wall.view.maps, {}, 16}).empty());
}

TEST(BlockerGapCache, AreFoundOnce)
{
    FakeLight light;
    light.blockers[0] = {3, 0.5, 2, 4};
    light.blockers[1] = {3, 1.5, 2, 4};
    const std::vector<std::size_t> first{0};
    const std::vector<std::size_t> both{0, 1};
    BlockerGapCache known{{2, 1}};
    known.find(light, first);
    light.blockers.erase(0); // asked again, the light would throw
    known.find(light, both);
    EXPECT_EQ(known.gap_m(0), 0.5);
    EXPECT_EQ(known.gap_m(1), 1.5);
}

TEST(BlockerGapCache, AreToWhatTheCullingLeaves)
{
    FakeLight light;
    light.blockers[0] = {3, 2.5, 2, 4};
    light.blockers_left[0] = {4, 0.5, 3, 4};
    light.blockers_left[1] = {scene::no_triangle, 0, 0, 0};
    const std::vector<std::size_t> both{0, 1};
    BlockerGapCache known{{2, 1}, scene::Cull::front};
    known.find(light, both);
    EXPECT_EQ(known.gap_m(0), 0.5);
    EXPECT_EQ(known.gap_m(1), std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace gnomon::analysis
