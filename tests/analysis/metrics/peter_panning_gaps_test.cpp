#include "analysis/metrics/peter_panning_gaps.hpp"

#include "fake_light.hpp"
#include "random_biases.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::infinity;
using test::random_biases;
using test::random_depth;

/// Two pixels on a wall at ζ = 4, with the light at the camera.
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
    light.blockers.erase(0); // a second query would throw
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

TEST(GapsAtBiases, GrowWithTheBias)
{
    const std::vector<PanningGap> gaps{{0.5F, {3, 30}}, {0.25F, {1, 10}}, {-infinity, {2, 20}}};
    const std::vector<float> biases{0, 0.25F, 0.5F};
    const auto rows = find_gaps_at(gaps, biases, {});
    EXPECT_EQ(rows[0].metres, (Quantiles{1, 2, 2, 2, 2}));
    EXPECT_EQ(rows[1].metres, (Quantiles{2, 1, 1, 2, 2}));
    EXPECT_EQ(rows[2].metres, (Quantiles{3, 1, 2, 3, 3}));
    EXPECT_EQ(rows[2].texels, (Quantiles{3, 10, 20, 30, 30}));
}

TEST(GapsAtBiases, AreEmptyWhereNothingPans)
{
    const std::vector<PanningGap> gaps{{0.5F, {3, 30}}, {infinity, {1, 10}}};
    const std::vector<float> biases{previous_bias(0.5F)};
    EXPECT_EQ(find_gaps_at(gaps, biases, {})[0].metres, std::nullopt);
    EXPECT_EQ(find_gaps_at(gaps, biases, {})[0].texels, std::nullopt);
}

TEST(GapsAtBiases, AreNoLongerThanTheBiasesReach)
{
    const std::vector<PanningGap> gaps{{0.25F, {4, 8}, 7}, {-infinity, {1, 2}, 8}};
    const auto reach = [](std::size_t pixel, float bias) {
        return pixel == 7 ? 4 * double{bias} : 0.5;
    };
    const std::vector<float> biases{0.25F, 0.5F, 1, 2};
    const auto rows = find_gaps_at(gaps, biases, reach);
    EXPECT_EQ(rows[0].metres, (Quantiles{2, 0.5F, 0.5F, 1, 1}));
    EXPECT_EQ(rows[0].texels, (Quantiles{2, 1, 1, 2, 2}));
    EXPECT_EQ(rows[1].metres, (Quantiles{2, 0.5F, 0.5F, 2, 2}));
    EXPECT_EQ(rows[2].metres, (Quantiles{2, 0.5F, 0.5F, 4, 4}));
    EXPECT_EQ(rows[3].metres, rows[2].metres) << "reached wholly";
}

TEST(GapsAtBiases, LeaveOutPixelsThatNothingShouldHaveShadowed)
{
    const std::vector<PanningGap> gaps{{0, {infinity, infinity}, 0}, {0, {1, 2}, 1}};
    const std::vector<float> biases{1};
    const auto reach = [](std::size_t, float) { return 0.5; };
    EXPECT_EQ(find_gaps_at(gaps, biases, reach)[0].metres, (Quantiles{1, 0.5F, 0.5F, 0.5F, 0.5F}));
}

/// Each pixel's biases reach k times as far as the bias, plus a length of its own.
TEST(GapsAtBiases, AgreeWithMeasuringEachBiasByItself)
{
    std::mt19937 random{33};
    for (int round = 0; round < 1000; ++round) {
        std::vector<PanningGap> gaps(random() % 60);
        std::vector<float> criticals;
        for (PanningGap& gap : gaps) {
            gap.critical_bias = random() % 9 == 0 ? -infinity : random_depth(random) - 0.5F;
            // Few distinct lengths, so that many are equal; some are not finite, as next to a
            // light.
            gap.gap = {static_cast<float>(random() % 12),
                       random() % 20 == 0 ? infinity : static_cast<float>(random() % 12)};
            gap.pixel = random() % 100;
            criticals.push_back(gap.critical_bias);
        }
        const auto biases = random_biases(random, criticals);
        const auto reach = [](std::size_t pixel, float bias) {
            return static_cast<double>(pixel) / 16 + 20 * std::max(0.0, double{bias});
        };
        const auto rows = find_gaps_at(gaps, biases, reach);
        ASSERT_EQ(rows.size(), biases.size());
        for (std::size_t i = 0; i < biases.size(); ++i) {
            std::vector<float> metres;
            std::vector<float> texels;
            for (const PanningGap& gap : gaps) {
                if (gap.critical_bias <= biases[i]) {
                    const double most_m = reach(gap.pixel, biases[i]);
                    const bool is_limited = most_m < double{gap.gap.metres};
                    const double share = is_limited ? most_m / double{gap.gap.metres} : 1;
                    metres.push_back(is_limited ? static_cast<float>(most_m) : gap.gap.metres);
                    texels.push_back(static_cast<float>(double{gap.gap.texels} * share));
                }
            }
            ASSERT_EQ(rows[i].metres, find_quantiles(metres))
                << "round " << round << ", " << biases[i];
            ASSERT_EQ(rows[i].texels, find_quantiles(texels))
                << "round " << round << ", " << biases[i];
        }
    }
}

} // namespace
} // namespace gnomon::analysis
