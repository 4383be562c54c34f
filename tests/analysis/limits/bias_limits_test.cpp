#include "analysis/limits/bias_limits.hpp"

#include "curve_case.hpp"
#include "lane.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::infinity;
using scene::PixelClass;

using PixelClass::blocked;
using PixelClass::lit;

BiasBounds bounds_of(const std::vector<CurvePixel>& pixels, const ForgiveGaps& forgive = nullptr)
{
    const CurveImages images{pixels};
    return find_bias_bounds(images.curve(), images.criticals, images.classes, images.acne_free(),
                            forgive);
}

TEST(BiasBounds, LieAtTheLastAcneAndBelowTheFirstPanning)
{
    const BiasBounds bounds = bounds_of({{lit, 0.125F, true},
                                         {lit, 0.25F, true},
                                         {lit, 0.75F, false}, // an edge, not acne
                                         {blocked, 0.5F},
                                         {blocked, 1.0F}});
    EXPECT_EQ(bounds.strict.acne_free, 0.25F);
    EXPECT_EQ(bounds.strict.panning_free, previous_bias(0.5F));
    EXPECT_FALSE(bounds.strict.cross());
    EXPECT_FALSE(bounds.no_constant_bias_serves);
}

TEST(BiasBounds, AreInfiniteWhereNothingLimits)
{
    const BiasBounds none = bounds_of({{lit, 0.5F, false}, {blocked, infinity}});
    for (const BiasLimits& limits : {none.strict, none.allowances[0]}) {
        EXPECT_EQ(limits.acne_free, -infinity);
        EXPECT_EQ(limits.panning_free, infinity);
        EXPECT_EQ(limits.panning_free_beyond_zero, infinity);
        EXPECT_FALSE(limits.cross());
    }
}

TEST(BiasBounds, AreOutOfReachWhereTheBorderDecides)
{
    const BiasBounds bounds = bounds_of({{lit, infinity, true}, {blocked, -infinity}});
    EXPECT_EQ(bounds.strict.acne_free, infinity);
    EXPECT_EQ(bounds.strict.panning_free, -infinity);
    EXPECT_TRUE(bounds.no_constant_bias_serves);
    EXPECT_TRUE(bounds_of({{blocked, -infinity}}).strict.cross());
    EXPECT_TRUE(bounds_of({{lit, infinity, true}}).strict.cross());
}

TEST(BiasBounds, LeaveOutWhatIsFalseLitWithoutBias)
{
    const BiasBounds bounds =
        bounds_of({{blocked, -0.5F}, {blocked, 0.0F}, {blocked, 0.25F}, {lit, 0.125F, true}});
    EXPECT_EQ(bounds.strict.panning_free, previous_bias(-0.5F));
    EXPECT_EQ(bounds.strict.panning_free_beyond_zero, previous_bias(0.25F));
    EXPECT_EQ(bounds.allowances[2].panning_free_beyond_zero, previous_bias(0.25F));
}

/// 1000 lit and 1000 blocked pixels, each with critical biases 1/1024, 2/1024, ….
std::vector<CurvePixel> thousands()
{
    std::vector<CurvePixel> pixels;
    for (int i = 1; i <= 1000; ++i) {
        pixels.push_back({lit, static_cast<float>(i) / 1024.0F, true});
        pixels.push_back({blocked, static_cast<float>(i) / 1024.0F});
    }
    return pixels;
}

TEST(BiasBounds, AllowAShareOfTheScoredPixels)
{
    const BiasBounds bounds = bounds_of(thousands());
    EXPECT_EQ(bounds.allowances[0].allowance, 0.0001);
    EXPECT_EQ(bounds.allowances[1].allowance, 0.001);
    EXPECT_EQ(bounds.allowances[2].allowance, 0.01);
    EXPECT_EQ(bounds.allowances[0].allowed_pixels, 0U);
    EXPECT_EQ(bounds.allowances[1].allowed_pixels, 2U);
    EXPECT_EQ(bounds.allowances[2].allowed_pixels, 20U);
    EXPECT_EQ(bounds.allowances[1].acne_free, 998.0F / 1024.0F);
    EXPECT_EQ(bounds.allowances[1].panning_free, previous_bias(3.0F / 1024.0F));
    EXPECT_TRUE(bounds.no_constant_bias_serves);
}

TEST(BiasBounds, ForgiveGapsForTheAllowancesOnly)
{
    // In thousands(), the odd pixels are blocked; those up to 100/1024 are forgiven.
    const BiasBounds bounds = bounds_of(thousands(), [](std::span<const std::size_t> pixels) {
        std::vector<std::uint8_t> forgiven;
        for (const std::size_t pixel : pixels) {
            forgiven.push_back(pixel < 200 ? 1 : 0);
        }
        return forgiven;
    });
    EXPECT_EQ(bounds.strict.panning_free, previous_bias(1.0F / 1024.0F));
    EXPECT_EQ(bounds.allowances[0].panning_free, previous_bias(101.0F / 1024.0F));
    EXPECT_EQ(bounds.allowances[2].panning_free, previous_bias(121.0F / 1024.0F));
}

TEST(BiasBounds, AskForNoMoreGapsThanTheyNeed)
{
    std::vector<CurvePixel> pixels;
    for (int i = 0; i < 100'000; ++i) {
        pixels.push_back({blocked, static_cast<float>(100'000 - i) * 1e-6F});
    }
    std::vector<std::size_t> asked;
    const BiasBounds bounds = bounds_of(pixels, [&](std::span<const std::size_t> piece) {
        asked.insert(asked.end(), piece.begin(), piece.end());
        return std::vector<std::uint8_t>(piece.size(), 0);
    });
    // The decision needs one more than 1 % of the pixels, and both limits need the same ones.
    EXPECT_LE(asked.size(), 1024U);
    EXPECT_EQ(asked.front(), 99'999U);
    EXPECT_TRUE(std::is_sorted(asked.rbegin(), asked.rend()));
    EXPECT_EQ(bounds.allowances[2].panning_free, previous_bias(1001 * 1e-6F));
}

bool is_forgiven(std::size_t pixel)
{
    return pixel % 3 == 0;
}

std::uint64_t count_acne(const std::vector<CurvePixel>& pixels, float bias)
{
    return static_cast<std::uint64_t>(
        std::count_if(pixels.begin(), pixels.end(), [&](const CurvePixel& pixel) {
            return pixel.pixel_class == lit && pixel.is_acne && pixel.critical > bias;
        }));
}

std::uint64_t count_panning(const std::vector<CurvePixel>& pixels, float bias, bool is_strict,
                            bool beyond_zero)
{
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const bool counts = pixels[i].pixel_class == blocked && (is_strict || !is_forgiven(i)) &&
                            (!beyond_zero || pixels[i].critical > 0.0F);
        count += counts && pixels[i].critical <= bias ? 1U : 0U;
    }
    return count;
}

TEST(BiasBounds, EqualTheDefinitionsOnRandomPixels)
{
    std::mt19937 random{7};
    const int cases = tests::in_lane(15, 60);
    for (int i = 0; i < cases; ++i) {
        std::vector<CurvePixel> pixels = random_pixels(random);
        const std::vector<float> biases = telling_biases(pixels);
        // Adds 10^4 pixels that are always right, so that the allowances differ.
        pixels.resize(10'000 + pixels.size(), CurvePixel{lit, -infinity});
        const BiasBounds bounds = bounds_of(pixels, [](std::span<const std::size_t> piece) {
            std::vector<std::uint8_t> forgiven(piece.size());
            std::transform(piece.begin(), piece.end(), forgiven.begin(),
                           [](std::size_t pixel) { return is_forgiven(pixel) ? 1 : 0; });
            return forgiven;
        });
        for (const BiasLimits& limits :
             {bounds.strict, bounds.allowances[0], bounds.allowances[1], bounds.allowances[2]}) {
            const bool is_strict = limits.allowance == 0;
            const std::uint64_t allowed = limits.allowed_pixels;
            for (const float bias : biases) {
                ASSERT_EQ(bias >= limits.acne_free, count_acne(pixels, bias) <= allowed)
                    << "case " << i << " at " << bias;
                ASSERT_EQ(bias <= limits.panning_free,
                          count_panning(pixels, bias, is_strict, false) <= allowed)
                    << "case " << i << " at " << bias;
                ASSERT_EQ(bias <= limits.panning_free_beyond_zero,
                          count_panning(pixels, bias, is_strict, true) <= allowed)
                    << "case " << i << " at " << bias;
            }
        }
    }
}

TEST(BiasBounds, RejectImagesAndAnswersThatDoNotFit)
{
    const CurveImages images{{{lit, 0.5F, true}, {blocked, 0.75F}}};
    const BiasCurve curve = images.curve();
    EXPECT_THROW((void)find_bias_bounds(curve, images.criticals, scene::Image<PixelClass>{{1, 1}},
                                        images.acne_free(), nullptr),
                 std::invalid_argument);
    const ForgiveGaps mute = [](std::span<const std::size_t>) {
        return std::vector<std::uint8_t>{};
    };
    EXPECT_THROW(
        (void)find_bias_bounds(curve, images.criticals, images.classes, images.acne_free(), mute),
        std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
