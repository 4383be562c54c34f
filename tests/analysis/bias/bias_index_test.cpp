#include "analysis/bias/bias_index.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace gnomon::analysis {
namespace {

using scene::infinity;

TEST(BiasIndex, FindsTheFirstThatIsNotBelow)
{
    const std::vector<float> biases{-1, 0, 1, 2};
    const BiasIndex index{biases};
    EXPECT_EQ(index.first_from(-1), 0U);
    EXPECT_EQ(index.first_from(-0.5F), 1U);
    EXPECT_EQ(index.first_from(-0.0F), 1U);
    EXPECT_EQ(index.first_from(0), 1U);
    EXPECT_EQ(index.first_from(2), 3U);
    EXPECT_EQ(index.first_from(3), 4U);
    EXPECT_EQ(index.first_from(-infinity), 0U);
    EXPECT_EQ(index.first_from(infinity), 4U);
    EXPECT_EQ(BiasIndex{{}}.first_from(0), 0U);
}

TEST(BiasIndex, FindsPlacesInListsOfOneAndOfExtremes)
{
    const std::vector<float> one{-0.0F};
    EXPECT_EQ(BiasIndex{one}.first_from(-1e-38F), 0U);
    EXPECT_EQ(BiasIndex{one}.first_from(0), 0U);
    EXPECT_EQ(BiasIndex{one}.first_from(1e-38F), 1U);
    const std::vector<float> extremes{-infinity, 0, infinity};
    const BiasIndex index{extremes};
    EXPECT_EQ(index.first_from(-infinity), 0U);
    EXPECT_EQ(index.first_from(std::numeric_limits<float>::lowest()), 1U);
    EXPECT_EQ(index.first_from(0), 1U);
    EXPECT_EQ(index.first_from(1), 2U);
    EXPECT_EQ(index.first_from(infinity), 2U);
}

TEST(BiasIndex, AgreesWithABinarySearch)
{
    constexpr unsigned seed = 12;
    std::mt19937 random{seed};
    const auto draw = [&](unsigned octaves) {
        const auto mantissa = static_cast<float>(static_cast<int>(random() % 2001) - 1000);
        return std::ldexp(mantissa,
                          static_cast<int>(random() % (octaves + 1)) - static_cast<int>(octaves));
    };
    for (unsigned run = 0; run < 60; ++run) {
        std::set<float> drawn; // few octaves: many biases share their leading bits
        while (drawn.size() < 500) {
            drawn.insert(draw(run));
        }
        const std::vector<float> biases{drawn.begin(), drawn.end()};
        const BiasIndex index{biases};
        for (int i = 0; i < 500; ++i) {
            const float value = i % 2 == 0 ? draw(run) : biases[random() % biases.size()];
            EXPECT_EQ(index.first_from(value),
                      static_cast<std::size_t>(
                          std::lower_bound(biases.begin(), biases.end(), value) - biases.begin()))
                << "seed " << seed << ", run " << run << ", value " << value;
        }
    }
}

} // namespace
} // namespace gnomon::analysis
