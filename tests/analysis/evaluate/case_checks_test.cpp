#include "analysis/evaluate/case_causes.hpp"
#include "analysis/evaluate/case_checks.hpp"
#include "analysis/evaluate/likely_mistakes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::Image;
using scene::PixelClass;
using scene::Vec3d;
using scene::Vec3f;

TEST(HalfPositions, AreTheValuesOfHalf)
{
    for (const float half : {0.0F, -1.5F, 0x1p-24F, 3 * 0x1p-24F, 65504.0F, 100.0625F, 0x1p-14F}) {
        EXPECT_TRUE(is_half(half)) << half;
    }
    for (const float other : {0x1p-25F, 65505.0F, 100.03F, 0.1F, NAN, INFINITY}) {
        EXPECT_FALSE(is_half(other)) << other;
    }
}

TEST(HalfPositions, AreToldFromAnEvenGrid)
{
    Image<Vec3f> grid{{64, 8}};
    Image<Vec3f> repeated{{64, 8}};
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto i = static_cast<float>(x);
            grid(x, y) = {i / 64, 0, static_cast<float>(y)};
            repeated(x, y) = {std::floor(i / 4), 0, static_cast<float>(y)};
        }
    }
    EXPECT_FALSE(are_rounded_to_half(grid, false));
    EXPECT_TRUE(are_rounded_to_half(grid, true));
    EXPECT_TRUE(are_rounded_to_half(repeated, false));
}

TEST(MixedAxes, AreAllOfThemAndEachOnce)
{
    std::set<std::string> texts;
    for (const MixedAxes& axes : all_axes()) {
        texts.insert(axes_text(axes));
    }
    EXPECT_EQ(texts.size(), 48U);
    EXPECT_EQ(axes_text(all_axes().front()), R"(["x", "y", "z"])");
}

TEST(MixedAxes, FollowEachOther)
{
    const Vec3d v{1, 2, 3};
    for (const MixedAxes& first : all_axes()) {
        for (const MixedAxes& second : all_axes()) {
            EXPECT_EQ(mixed(mixed_twice(first, second), v), mixed(second, mixed(first, v)))
                << axes_text(first) << axes_text(second);
            EXPECT_EQ(mirrors(mixed_twice(first, second)), mirrors(first) != mirrors(second));
        }
    }
}

TEST(MaskAgreement, IsOneForTheTruthAndZeroForNoWord)
{
    const Image<PixelClass> classes{{4, 1}, PixelClass::lit};
    Image<PixelClass> both = classes;
    both[0] = both[1] = PixelClass::blocked;
    Image<float> mask{{4, 1}, 1.0F};
    EXPECT_EQ(agreement(mask, both).index(), 0);
    mask[0] = mask[1] = 0;
    EXPECT_EQ(agreement(mask, both).index(), 1);
    mask[0] = mask[1] = 1;
    mask[2] = mask[3] = 0;
    EXPECT_EQ(agreement(mask, both).index(), -1);
    EXPECT_FALSE(agreement(mask, classes).has_both());
}

TEST(MaskAgreement, SeesShadowsThatAreTooLightToCount)
{
    const Image<PixelClass> classes{{4, 1}, PixelClass::lit};
    Image<PixelClass> both = classes;
    both[0] = both[1] = PixelClass::blocked;
    Image<float> mask{{4, 1}, 1.0F};
    EXPECT_EQ(agreement(mask, both).darkening(), 0);
    mask[0] = 0.75F;
    mask[1] = 0.5F;
    EXPECT_EQ(agreement(mask, both).index(), 0);
    EXPECT_EQ(agreement(mask, both).darkening(), 0.375);
    EXPECT_EQ(agreement(mask, classes).darkening(), 0);
}

TEST(BiasCauses, AreWhatTheVerdictWithoutBiasGetsRight)
{
    scene::CaseLayers layers;
    const scene::ImageSize size{5, 1};
    layers.position = Image<Vec3f>{size};
    layers.mask = Image<float>{size};
    layers.z_light = Image<float>{size, 0.5F};
    layers.z_map = Image<float>{size, 0.4F};
    scene::Truth truth{Image<PixelClass>{size, PixelClass::blocked}, {}, {}, {}};
    layers.mask[0] = 1; // r > d: shadowed without bias
    layers.mask[1] = 1;
    layers.z_map[1] = 0.6F; // lit without bias too
    layers.mask[2] = 1;
    layers.z_map[2] = NAN;                  // the border decides
    truth.pixel_class[3] = PixelClass::lit; // r > d: shadowed without bias too
    truth.pixel_class[4] = PixelClass::lit;
    layers.z_map[4] = 0.5F; // equal: lit without bias
    const BiasCauses found = find_bias_causes(layers, truth, false);
    EXPECT_EQ(found.peter_panning, 1U);
    EXPECT_EQ(found.overshadow, 1U);
    EXPECT_EQ(found.unknown, 3U);
    EXPECT_EQ(found.cause[0], Cause::bias);
    EXPECT_EQ(found.label[4], Label::overshadow);
    EXPECT_EQ(find_bias_causes(layers, truth, true).peter_panning, 1U); // r < d: pixel 1
}

TEST(SharedPosition, StandsOutFromNeighboursThatRepeat)
{
    std::vector<Vec3d> points;
    for (int i = 0; i < 1000; ++i) {
        points.emplace_back(i / 8, 0, 0); // float32 is too coarse for this camera
    }
    EXPECT_FALSE(check_shared_position(points));
    points.insert(points.end(), 79, Vec3d{-1, 0, 0}); // less than ten times as many
    EXPECT_FALSE(check_shared_position(points));
    points.emplace_back(-1, 0, 0);
    ASSERT_TRUE(check_shared_position(points));
    EXPECT_EQ(check_shared_position(points)->name, "background");
    // Too few pixels for a background.
    EXPECT_FALSE(check_shared_position(std::vector<Vec3d>(15, Vec3d{0.0})));
}

TEST(ImportDistances, AreNearestRanks)
{
    std::vector<double> distances;
    for (int i = 100; i >= 1; --i) {
        distances.push_back(i);
    }
    const ImportDistances found = summarise_distances(distances, 0.5, 7);
    EXPECT_EQ(found.median_m, 25);
    EXPECT_EQ(found.p99_m, 49.5);
    EXPECT_EQ(found.max_m, 50);
}

} // namespace
} // namespace gnomon::analysis
