#include "analysis/recommendation/broad_minimum.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::infinity;

TEST(ErrorPieces, BeginAtZeroAndEndNowhere)
{
    const std::vector<float> lit{-1.0F, 0.25F, 0.5F};
    const std::vector<float> blocked{-2.0F, 0.5F, infinity};
    const std::vector<ErrorPiece> pieces{
        {0, previous_bias(0.25F), 3}, {0.25F, previous_bias(0.5F), 2}, {0.5F, infinity, 2}};
    EXPECT_EQ(error_pieces(lit, blocked), pieces);
    EXPECT_EQ(error_pieces({}, {}), (std::vector<ErrorPiece>{{0, infinity, 0}}));
}

TEST(BroadMinimum, IsABroadRun)
{
    const std::vector<ErrorPiece> pieces{{0, 0.125F, 90}, {0.25F, 0.5F, 4}, {1, infinity, 50}};
    const auto broad_minimum = find_broad_minimum(pieces);
    ASSERT_TRUE(broad_minimum);
    EXPECT_EQ(broad_minimum->run, (BiasInterval{0.25F, 0.5F}));
    EXPECT_EQ(broad_minimum->least, 4);
    EXPECT_EQ(broad_minimum->level, 6) << "m + √m";
}

TEST(BroadMinimum, IsNoSpike)
{
    // One error at a spike, nine along a plain: a broad run needs the plain's level.
    const std::vector<ErrorPiece> pieces{
        {0, 0.1F, 99}, {0.125F, 0.2F, 9}, {0.25F, 0.375F, 12}, {0.5F, 0.51F, 1}, {0.6F, 1, 80}};
    const auto broad_minimum = find_broad_minimum(pieces);
    ASSERT_TRUE(broad_minimum);
    EXPECT_EQ(broad_minimum->level, 9);
    EXPECT_EQ(broad_minimum->run, (BiasInterval{0.125F, 0.2F}));
}

TEST(BroadMinimum, HoldsNeighboursThatAreNearlyAsGood)
{
    // m = 16: errors up to 20 are as good.
    const std::vector<ErrorPiece> pieces{
        {0, 0.5F, 40}, {1, 1.25F, 20}, {1.25F, 1.375F, 16}, {1.375F, 2, 19}, {2, infinity, 21}};
    const auto broad_minimum = find_broad_minimum(pieces);
    ASSERT_TRUE(broad_minimum);
    EXPECT_EQ(broad_minimum->run, (BiasInterval{1, 2}));
}

TEST(BroadMinimum, OfSeveralIsTheLowest)
{
    const std::vector<ErrorPiece> pieces{
        {0, 0.5F, 40}, {1, 2, 3}, {2, 3, 30}, {4, 8, 2}, {8, 16, 30}};
    EXPECT_EQ(find_broad_minimum(pieces)->run, (BiasInterval{1, 2})) << "3 <= 2 + √2";
}

TEST(BroadMinimum, IsBroadWhereItHoldsZero)
{
    const std::vector<ErrorPiece> pieces{{0, 1e-6F, 0}, {1e-6F, infinity, 5}};
    EXPECT_EQ(find_broad_minimum(pieces)->run, (BiasInterval{0, 1e-6F}));
}

TEST(BroadMinimum, IsMissingWithoutPieces)
{
    EXPECT_FALSE(find_broad_minimum({}));
    const std::vector<ErrorPiece> narrow{{1, 1.25F, 0}};
    EXPECT_FALSE(find_broad_minimum(narrow));
}

/// The definition, literally: tries every level and every run.
std::optional<BiasInterval> minimum_by_trying(const std::vector<ErrorPiece>& pieces)
{
    double least = infinity;
    for (const ErrorPiece& piece : pieces) {
        least = std::min(least, piece.error);
    }
    std::vector<double> levels{least + std::sqrt(least)};
    for (const ErrorPiece& piece : pieces) {
        if (piece.error >= levels.front()) {
            levels.push_back(piece.error);
        }
    }
    std::ranges::sort(levels);
    for (const double level : levels) {
        for (std::size_t first = 0; first < pieces.size(); ++first) {
            const bool begins =
                pieces[first].error <= level && (first == 0 || pieces[first - 1].error > level);
            std::size_t last = first;
            while (last + 1 < pieces.size() && pieces[last + 1].error <= level) {
                ++last;
            }
            const double lo{pieces[first].lo};
            const double hi{pieces[last].hi};
            if (begins && (lo == 0 || hi >= 1.5 * lo)) {
                return BiasInterval{pieces[first].lo, pieces[last].hi};
            }
        }
    }
    return std::nullopt;
}

TEST(BroadMinimum, IsWhatTheDefinitionSaysOnRandomCurves)
{
    std::mt19937 random{20261124};
    for (int i = 0; i < 3000; ++i) {
        std::uniform_int_distribution<int> count{0, 12};
        std::uniform_real_distribution<float> exponent{-12, 0};
        const auto criticals = [&] {
            std::vector<float> all(static_cast<std::size_t>(count(random)));
            std::ranges::generate(all, [&] { return std::exp2(exponent(random)); });
            std::ranges::sort(all);
            return all;
        };
        const std::vector<float> lit = criticals();
        const std::vector<float> blocked = criticals();
        const auto pieces = error_pieces(lit, blocked);
        const auto broad_minimum = find_broad_minimum(pieces);
        const auto wanted = minimum_by_trying(pieces);
        ASSERT_EQ(broad_minimum.has_value(), wanted.has_value()) << i;
        if (broad_minimum) {
            EXPECT_EQ(broad_minimum->run, *wanted) << i;
        }
    }
}

TEST(AllowedBias, StaysWhatIsRecommendedWhereThatMeetsTheLimits)
{
    const std::vector<BiasInterval> allowed{{0, 8}};
    EXPECT_EQ(allowed_bias({1, 4}, 2, allowed), 2);
}

TEST(AllowedBias, IsTheNearestOfTheRunElse)
{
    const std::vector<BiasInterval> above{{3, 8}};
    EXPECT_EQ(allowed_bias({1, 4}, 2, above), 3);
    const std::vector<BiasInterval> both{{0, 1.75F}, {2.5F, 8}};
    EXPECT_EQ(allowed_bias({1, 4}, 2, both), 1.75F);
}

TEST(AllowedBias, IsTheLeastOfAllWhereNoneOfTheRunMeetsTheLimits)
{
    const std::vector<BiasInterval> beyond{{0.25F, 0.5F}, {5, 8}};
    EXPECT_EQ(allowed_bias({1, 4}, 2, beyond), 0.25F);
    EXPECT_FALSE(allowed_bias({1, 4}, 2, {}));
}

} // namespace
} // namespace gnomon::analysis
