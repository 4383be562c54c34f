#include "analysis/bias/bias_verification.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "lookup_case.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/infinity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::infinity;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

template <typename Pixel>
scene::Image<Pixel> row_of(const std::vector<Pixel>& pixels)
{
    scene::Image<Pixel> image{{static_cast<int>(pixels.size()), 1}};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        image[i] = pixels[i];
    }
    return image;
}

/// The last pixel shows no receiver.
const scene::Image<std::uint32_t> triangles =
    row_of<std::uint32_t>({0, 0, 1, 1, 1, scene::no_triangle});
const scene::Image<float> criticals = row_of<float>({0.25F, 0.25F, 0.5F, -infinity, infinity, 0});

/// A correct GL: lit from the critical bias on. The pixels in `wrong` give the opposite.
std::function<scene::LookupLayers(float)> lookups_with(const std::vector<std::size_t>& wrong)
{
    return [wrong](float constant) {
        std::vector<scene::LookupSample> samples(criticals.pixel_count());
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i].verdict = criticals[i] <= constant ? 1.0F : 0.0F;
        }
        for (const std::size_t i : wrong) {
            samples[i].verdict = 1.0F - samples[i].verdict;
        }
        return layers_of(samples);
    };
}

BiasVerification verify(const std::vector<float>& biases, const std::vector<std::size_t>& wrong)
{
    return verify_biases(triangles, criticals, biases, lookups_with(wrong));
}

TEST(VerifyBiases, FindsNoDifferenceWhereGlDoesWhatTheCriticalBiasesSay)
{
    const std::vector<float> biases{0, previous_bias(0.25F), 0.25F, next_bias(0.25F), 0.5F};
    const BiasVerification verification = verify(biases, {});
    ASSERT_EQ(verification.reruns.size(), 5U);
    EXPECT_EQ(verification.reruns[1].lit, 1U);
    EXPECT_EQ(verification.reruns[1].shadowed, 4U);
    EXPECT_EQ(verification.reruns[2].lit, 3U);
    EXPECT_EQ(verification.reruns[2].bias, 0.25F);
    EXPECT_EQ(verification.verdicts(), 25U) << "five pixels show a receiver";
    EXPECT_EQ(verification.differences(), 0U);
}

TEST(VerifyBiases, CountsEveryVerdictThatDiffers)
{
    const BiasVerification verification = verify({0, 0.5F}, {1, 4});
    EXPECT_EQ(verification.reruns[0].differences, 2U);
    EXPECT_EQ(verification.differences(), 4U);
}

TEST(VerifyBiases, LeavesPixelsWithoutAReceiverOut)
{
    EXPECT_EQ(verify({0, 0.5F}, {5}).differences(), 0U);
}

TEST(VerifyBiases, CountsNothingWithoutBiases)
{
    const BiasVerification verification = verify({}, {0});
    EXPECT_EQ(verification.verdicts(), 0U);
    EXPECT_EQ(verification.differences(), 0U);
}

TEST(VerifyBiases, RejectsLayersOfAnotherSize)
{
    const std::vector<float> biases{0};
    const auto verify_in = [&](const scene::Image<float>& others) {
        return verify_biases(triangles, others, biases, lookups_with({}));
    };
    EXPECT_THROW((void)verify_in(row_of<float>({0, 1})), std::invalid_argument);
    const auto others = [](float) { return layers_of(std::vector<scene::LookupSample>(3)); };
    EXPECT_THROW((void)verify_biases(triangles, criticals, biases, others), std::invalid_argument);
}

TEST(BiasesToVerify, AreThoseWantedAndTheEdgesOfTheTurns)
{
    const std::vector<float> wanted{1, 0.25F};
    EXPECT_THAT(biases_to_verify(criticals, triangles, wanted),
                ElementsAre(previous_bias(0.25F), 0.25F, next_bias(0.25F), previous_bias(0.5F),
                            0.5F, next_bias(0.5F), 1.0F));
}

TEST(BiasesToVerify, SpreadOverManyTurnsByRank)
{
    std::vector<float> values;
    for (int i = 0; i <= 40; ++i) {
        values.push_back(static_cast<float>(40 - i) / 64);
    }
    const auto many = row_of(values);
    const scene::Image<std::uint32_t> everywhere{many.size(), 0};
    const auto biases = biases_to_verify(many, everywhere, {});
    ASSERT_EQ(biases.size(), 15U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(biases[3 * i + 1], static_cast<float>(10 * i) / 64);
    }
}

TEST(BiasesToVerify, AreFiniteAndMayBeNone)
{
    const float largest = std::numeric_limits<float>::max();
    const auto turns = row_of<float>({largest, -largest});
    const scene::Image<std::uint32_t> everywhere{turns.size(), 0};
    EXPECT_THAT(biases_to_verify(turns, everywhere, {}),
                ElementsAre(-largest, next_bias(-largest), previous_bias(largest), largest));
    const scene::Image<float> never{turns.size(), infinity};
    EXPECT_THAT(biases_to_verify(never, everywhere, {}), IsEmpty());
}

} // namespace
} // namespace gnomon::analysis
