#include "analysis/pixels/error_clusters.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

/// An image of rows of equal length, marked where there is an x.
scene::Image<std::uint8_t> image_of(const std::vector<std::string>& rows)
{
    scene::Image<std::uint8_t> image{
        {static_cast<int>(rows.front().size()), static_cast<int>(rows.size())}};
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        image[i] = rows[i / rows.front().size()][i % rows.front().size()] == 'x' ? 1 : 0;
    }
    return image;
}

TEST(LargestCluster, IsOnePixel)
{
    EXPECT_EQ(largest_cluster(image_of({"...", "..x"})), (PixelCluster{1, 2, 1}));
}

TEST(LargestCluster, JoinsDiagonalNeighbours)
{
    EXPECT_EQ(largest_cluster(image_of({"x..", ".x.", "..x"})), (PixelCluster{3, 1, 1}));
    EXPECT_EQ(largest_cluster(image_of({"..x", ".x.", "x.."})), (PixelCluster{3, 1, 1}));
}

TEST(LargestCluster, IsTheLargerOneWhereverItIs)
{
    EXPECT_EQ(largest_cluster(image_of({"x.xxx", "....."})), (PixelCluster{3, 3, 0}));
    EXPECT_EQ(largest_cluster(image_of({"xxx.x", "....."})), (PixelCluster{3, 1, 0}));
}

TEST(LargestCluster, IsTheFirstOfEquallyLargeOnes)
{
    EXPECT_EQ(largest_cluster(image_of({"....x", ".....", "x...."})), (PixelCluster{1, 4, 0}));
}

TEST(LargestCluster, DoesNotJoinTheEndsOfRows)
{
    EXPECT_EQ(largest_cluster(image_of({"...x", "x...", "...."})), (PixelCluster{1, 3, 0}));
}

TEST(LargestCluster, HasItsMiddleOnItself)
{
    // The centroid of the ring is its hole; the four sides are equally near.
    EXPECT_EQ(largest_cluster(image_of({"xxx", "x.x", "xxx"})), (PixelCluster{8, 1, 0}));
}

TEST(LargestCluster, IsMissingWithoutMarks)
{
    EXPECT_EQ(largest_cluster(image_of({"...", "..."})), std::nullopt);
    EXPECT_EQ(largest_cluster({}), std::nullopt);
}

TEST(WrongPixels, AreScoredAndOnTheWrongSideOfOneHalf)
{
    using scene::PixelClass;
    scene::Truth truth;
    truth.pixel_class = scene::Image<PixelClass>{{6, 1}, PixelClass::lit};
    scene::LookupLayers lookup{scene::Image<scene::LookupSample>{{6, 1}}};
    const auto set = [&](std::size_t pixel, PixelClass pixel_class, float verdict) {
        truth.pixel_class[pixel] = pixel_class;
        lookup.samples[pixel].verdict = verdict;
    };
    set(0, PixelClass::lit, 1);
    set(1, PixelClass::lit, 0.25F);
    set(2, PixelClass::blocked, 0);
    set(3, PixelClass::blocked, 0.75F);
    set(4, PixelClass::lit, 0.5F);
    set(5, PixelClass::attached, 1);
    const auto wrong = wrong_pixels(truth, lookup);
    EXPECT_EQ((std::vector<int>{wrong.begin(), wrong.end()}), (std::vector<int>{0, 1, 0, 1, 0, 0}));
}

TEST(WrongPixels, RejectLayersOfTwoSizes)
{
    EXPECT_THROW((void)wrong_pixels({}, {scene::Image<scene::LookupSample>{{2, 1}}}),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
