#include "analysis/pixels/statistics.hpp"

#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::infinity;

const float no_number = std::nanf("");

TEST(Quantiles, AreValuesOfNearestRank)
{
    EXPECT_EQ(find_quantiles({3, 1, 2}), (Quantiles{3, 1, 2, 3, 3}));
    EXPECT_EQ(find_quantiles({4, 1, 2, 3}), (Quantiles{4, 1, 2, 4, 4}));
    std::vector<float> hundred(100);
    for (std::size_t i = 0; i < 100; ++i) {
        hundred[i] = static_cast<float>(100 - i);
    }
    EXPECT_EQ(find_quantiles(hundred), (Quantiles{100, 1, 50, 95, 100}));
}

TEST(Quantiles, LeaveOutWhatIsNotFinite)
{
    EXPECT_EQ(find_quantiles({infinity, -infinity, no_number, -2}), (Quantiles{1, -2, -2, -2, -2}));
    EXPECT_FALSE(find_quantiles({infinity, no_number}).has_value());
    EXPECT_FALSE(find_quantiles(std::vector<float>{}).has_value());
}

TEST(Quantiles, AreThoseOfTheSortedValuesWhateverTheirSpread)
{
    constexpr unsigned seed = 11;
    std::mt19937 random{seed};
    for (int run = 0; run < 300; ++run) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", run " << run);
        const unsigned spread = static_cast<unsigned>(run) % 60; // octaves
        std::vector<float> values(1 + random() % 3000);
        for (float& value : values) {
            const auto mantissa = static_cast<float>(static_cast<int>(random() % 2001) - 1000);
            value = std::ldexp(mantissa, static_cast<int>(random() % (spread + 1)) -
                                             static_cast<int>(spread));
        }
        std::vector<float> sorted = values;
        std::ranges::sort(sorted);
        const auto nth = [&](std::size_t percent) {
            return sorted[quantile_rank(sorted.size(), percent) - 1];
        };
        EXPECT_EQ(find_quantiles(std::move(values)),
                  (Quantiles{sorted.size(), sorted.front(), nth(50), nth(95), sorted.back()}));
    }
}

} // namespace
} // namespace gnomon::analysis
