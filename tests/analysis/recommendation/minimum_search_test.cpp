#include "analysis/recommendation/minimum_search.hpp"

#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace gnomon::analysis {
namespace {

/// A curve from a formula, which counts how often it is sampled.
struct FakeCurve {
    std::function<SoftAmounts(float)> at;
    std::size_t measured = 0;

    [[nodiscard]] SampledCurve asked()
    {
        return {[this](std::span<const float> biases) {
                    std::vector<ErrorAmounts> amounts;
                    for (const float bias : biases) {
                        amounts.push_back(at(bias).amounts);
                    }
                    return amounts;
                },
                [this](std::span<const float> biases) {
                    EXPECT_TRUE(std::ranges::is_sorted(biases));
                    measured += biases.size();
                    std::vector<SoftAmounts> found;
                    std::ranges::transform(biases, std::back_inserter(found), at);
                    return found;
                }};
    }
};

/// Amounts of shadow and light, and the soft part of each.
SoftAmounts soft(double shadow, double light, double soft_shadow, double soft_light)
{
    return {{shadow, light, 0, 0}, {soft_shadow, soft_light}};
}

/// The rule, literally: every bias of the ladder, with softening limited to that at 0.
std::optional<BroadMinimum> minimum_of_all(const std::function<SoftAmounts(float)>& at)
{
    std::vector<ErrorPiece> pieces;
    const Softening at_zero = at(0).softening;
    for (const float bias : fine_biases()) {
        const SoftAmounts found = at(bias);
        pieces.push_back(
            {bias, bias, found.amounts.total() - left_out(found.softening, at_zero).total()});
    }
    pieces.back().hi = scene::infinity;
    return find_broad_minimum(pieces);
}

TEST(MinimumSearch, StandsAroundTheLeastErrorWithoutSoftening)
{
    // With softening, the least error is at 0.1, where the border no longer softens. Without it,
    // the least is at 1e-3, where there is neither acne nor lost shadow.
    const auto at = [](float bias) {
        const double acne = bias < 1e-3F ? 300 : 0;
        const double lost = bias > 2e-3F ? 400 : 0;
        const double border = bias < 0.05F ? 900 : 0;
        return soft(acne + border, lost, border, 0);
    };
    FakeCurve curve{at};
    const SampledMinimum found = search_broad_minimum(curve.asked(), BiasSteps::fine);
    ASSERT_TRUE(found.broad_minimum);
    EXPECT_EQ(found.broad_minimum->least, 0);
    EXPECT_GE(found.broad_minimum->run.lo, 1e-3F);
    EXPECT_LE(found.broad_minimum->run.hi, 2e-3F);
    EXPECT_EQ(found.broad_minimum->run, minimum_of_all(at)->run);
}

TEST(MinimumSearch, FollowsTheValleyToItsEnds)
{
    // Three and a half decades: 64 biases cover one and three quarters.
    const auto at = [](float bias) {
        return soft(bias < 1e-5F ? 900 : 0, bias > 0.03F ? 900 : 0, 0, 0);
    };
    FakeCurve curve{at};
    const SampledMinimum found = search_broad_minimum(curve.asked(), BiasSteps::fine);
    ASSERT_TRUE(found.broad_minimum);
    EXPECT_EQ(found.broad_minimum->run, minimum_of_all(at)->run);
    EXPECT_LT(found.pieces.front().lo, found.broad_minimum->run.lo);
    EXPECT_GT(found.pieces.back().lo, found.broad_minimum->run.hi);
}

TEST(MinimumSearch, KnowsNoEndWhereAllIsWell)
{
    FakeCurve curve{[](float) { return soft(0, 0, 0, 0); }};
    const SampledMinimum found = search_broad_minimum(curve.asked(), BiasSteps::fine);
    ASSERT_TRUE(found.broad_minimum);
    EXPECT_EQ(found.broad_minimum->run, (BiasInterval{0, scene::infinity}));
}

TEST(MinimumSearch, LeavesOutNoMoreThanWhatIsSoftWithoutABias)
{
    // From 1e-3 on every blocked pixel is lit and counted as softened; the border had 10 of them.
    const auto at = [](float bias) {
        return bias < 1e-3F ? soft(40, 10, 0, 10) : soft(0, 3657, 0, 3657);
    };
    FakeCurve curve{at};
    const SampledMinimum found = search_broad_minimum(curve.asked(), BiasSteps::fine);
    ASSERT_TRUE(found.broad_minimum);
    EXPECT_EQ(found.broad_minimum->run.lo, 0)
        << "40 px of acne are better than 3,647 px of lost shadow";
    EXPECT_EQ(found.broad_minimum->least, 40);
}

/// Decreasing acne, softening borders and lost shadows, each in its own place. The search finds the
/// broad minimum of all biases.
TEST(MinimumSearch, FindsWhatAllBiasesTellOnRandomCurves)
{
    std::mt19937 random{20261128};
    std::uniform_real_distribution<double> exponent{-5.5, -0.5};
    std::uniform_real_distribution<double> amount{100, 4000};
    for (int i = 0; i < 400; ++i) {
        std::array ends{exponent(random), exponent(random)};
        std::ranges::sort(ends);
        const double acne = amount(random);
        const double lost = amount(random);
        const double border = amount(random);
        const double border_end = exponent(random);
        const auto at = [=](float bias) {
            const double place = bias > 0 ? std::log10(double{bias}) : -99;
            const double remains = place < border_end ? border : 0;
            // Both flanks rise without end, so there is a single minimum.
            const double left = place < ends[0] ? acne + std::min(9.0, ends[0] - place) : 0;
            const double right = place > ends[1] ? lost + place - ends[1] : 0;
            return soft(left + remains, right + remains, remains, remains);
        };
        FakeCurve curve{at};
        const SampledMinimum found = search_broad_minimum(curve.asked(), BiasSteps::fine);
        const auto wanted = minimum_of_all(at);
        ASSERT_EQ(found.broad_minimum.has_value(), wanted.has_value()) << i;
        if (wanted) {
            EXPECT_EQ(found.broad_minimum->least, wanted->least) << i;
            EXPECT_EQ(found.broad_minimum->run, wanted->run) << i;
        }
        // At most all biases: 0, the coarse ones, 64, and four times 64 at each end.
        EXPECT_LE(curve.measured, fine_biases().size()) << i;
    }
}

TEST(MinimumSearch, AsksForFewBiasesWhereStepsAreCoarse)
{
    FakeCurve curve{
        [](float bias) { return soft(bias < 1e-3F ? 300 : 0, bias > 2e-2F ? 400 : 0, 0, 0); }};
    const SampledMinimum found = search_broad_minimum(curve.asked(), BiasSteps::coarse);
    ASSERT_TRUE(found.broad_minimum);
    EXPECT_GE(found.broad_minimum->run.lo, 1e-3F);
    EXPECT_LE(found.broad_minimum->run.hi, 2e-2F);
    EXPECT_LT(curve.measured, coarse_biases().size());
}

} // namespace
} // namespace gnomon::analysis
