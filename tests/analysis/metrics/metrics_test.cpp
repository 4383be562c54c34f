#include "analysis/metrics/metrics.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::ClassReason;
using scene::PixelClass;

struct MetricsPixel {
    PixelClass pixel_class;
    ClassReason reason = ClassReason::none;
    float verdict = 0;
};

struct Layers {
    scene::Truth truth;
    scene::LookupLayers lookup;
};

Layers layers_of(const std::vector<MetricsPixel>& pixels)
{
    const scene::ImageSize size{static_cast<int>(pixels.size()), 1};
    Layers layers;
    layers.truth.pixel_class = scene::Image<PixelClass>{size};
    layers.truth.reason = scene::Image<ClassReason>{size};
    layers.truth.witness = scene::Image<std::uint32_t>{size};
    layers.lookup.samples = scene::Image<scene::LookupSample>{size};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        layers.truth.pixel_class[i] = pixels[i].pixel_class;
        layers.truth.reason[i] = pixels[i].reason;
        layers.lookup.samples[i].verdict = pixels[i].verdict;
    }
    return layers;
}

Metrics measure(const std::vector<MetricsPixel>& pixels)
{
    const Layers layers = layers_of(pixels);
    return analysis::measure(layers.truth, layers.lookup, 0);
}

TEST(Measure, CountsEveryClassAndReason)
{
    const Metrics metrics = measure({
        {PixelClass::background},
        {PixelClass::unmatched, ClassReason::snap},
        {PixelClass::unmatched, ClassReason::snap},
        {PixelClass::unmatched, ClassReason::tie},
        {PixelClass::unmatched, ClassReason::mismatch},
        {PixelClass::attached},
        {PixelClass::attached},
        {PixelClass::out_of_light},
        {PixelClass::indeterminate, ClassReason::silhouette},
        {PixelClass::indeterminate, ClassReason::vertex},
        {PixelClass::indeterminate, ClassReason::graze},
        {PixelClass::lit, ClassReason::none, 1},
        {PixelClass::lit, ClassReason::none, 1},
        {PixelClass::blocked},
    });
    const ClassCounts& counts = metrics.pixels;
    EXPECT_EQ(counts.total, 14U);
    EXPECT_EQ(counts.by_class, (std::array<std::uint64_t, 7>{1, 4, 2, 1, 3, 2, 1}));
    EXPECT_EQ(counts.by_reason, (std::array<std::uint64_t, 8>{7, 2, 1, 1, 1, 1, 1, 0}));
    EXPECT_EQ(counts.scored(), 3U);
    EXPECT_EQ(counts.surface(), 13U);
    EXPECT_EQ(metrics.false_shadow + metrics.false_lit, 0U);
}

TEST(Measure, DividesEachErrorByItsOwnDenominator)
{
    const Metrics metrics = measure({
        {PixelClass::lit, ClassReason::none, 1},
        {PixelClass::lit, ClassReason::none, 1},
        {PixelClass::lit, ClassReason::none, 1},
        {PixelClass::lit, ClassReason::none, 0}, // false shadow
        {PixelClass::blocked, ClassReason::none, 0},
        {PixelClass::blocked, ClassReason::none, 1}, // false lit
        {PixelClass::blocked, ClassReason::none, 1}, // false lit
        {PixelClass::blocked, ClassReason::none, 1}, // false lit
    });
    EXPECT_EQ(metrics.false_shadow, 1U);
    EXPECT_EQ(metrics.false_lit, 3U);
    EXPECT_EQ(metrics.false_shadow_rate, 0.25);
    EXPECT_EQ(metrics.false_lit_rate, 0.75);
    EXPECT_EQ(metrics.error_rate, 0.5);
    EXPECT_EQ(metrics.mean_abs_error, 0.5);
}

TEST(Measure, CountsAVerdictOfOneHalfAsLit)
{
    const float below = std::nextafter(0.5F, 0.0F);
    const Metrics metrics = measure({
        {PixelClass::lit, ClassReason::none, 0.5F},
        {PixelClass::lit, ClassReason::none, below},
        {PixelClass::blocked, ClassReason::none, 0.5F},
        {PixelClass::blocked, ClassReason::none, below},
    });
    EXPECT_EQ(metrics.false_shadow, 1U);
    EXPECT_EQ(metrics.false_lit, 1U);
}

TEST(Measure, AveragesAbsoluteErrorsOfFilteredVerdicts)
{
    // Binary fractions, so that the sum 0.25 + 0.125 + 0.5 + 0.0 is exact.
    const Metrics metrics = measure({
        {PixelClass::lit, ClassReason::none, 0.75F},
        {PixelClass::blocked, ClassReason::none, 0.125F},
        {PixelClass::blocked, ClassReason::none, 0.5F},
        {PixelClass::lit, ClassReason::none, 1.0F},
        {PixelClass::attached, ClassReason::none, 0.5F}, // not scored
    });
    EXPECT_EQ(metrics.mean_abs_error, 0.21875);
}

TEST(Measure, ReadsTheShareOfTheLightThatIsSeen)
{
    Layers layers = layers_of({{PixelClass::lit, ClassReason::none, 0.25F},
                               {PixelClass::lit, ClassReason::none, 1.0F},
                               {PixelClass::blocked, ClassReason::none, 0.5F}});
    layers.truth.shares = scene::Image<scene::LightShare>{layers.truth.pixel_class.size()};
    layers.truth.shares[0] = {0.75F, 1.0F};
    layers.truth.shares[1] = {0.75F, 1.0F};
    layers.truth.shares[2] = {0.0F, 0.125F};
    const Metrics metrics = analysis::measure(layers.truth, layers.lookup, 0);
    EXPECT_EQ(metrics.amounts.shadow, 0.5);
    EXPECT_EQ(metrics.amounts.light, 0.375);
    EXPECT_EQ(metrics.false_shadow, 1U);
    EXPECT_EQ(metrics.false_lit, 1U);
}

TEST(Measure, CountsALitPixelThatIsTooBrightAsLight)
{
    Layers layers = layers_of({{PixelClass::lit, ClassReason::none, 1.0F}});
    layers.truth.shares = scene::Image<scene::LightShare>{layers.truth.pixel_class.size()};
    layers.truth.shares[0] = {0.25F, 0.5F};
    const Metrics metrics = analysis::measure(layers.truth, layers.lookup, 0);
    EXPECT_EQ(metrics.amounts.shadow, 0.0);
    EXPECT_EQ(metrics.amounts.light, 0.5);
}

TEST(Measure, LeavesRatesWithoutADenominatorEmpty)
{
    const Metrics none = measure({{PixelClass::background}});
    EXPECT_FALSE(none.false_shadow_rate || none.false_lit_rate || none.error_rate ||
                 none.mean_abs_error);
    const Metrics lit = measure({{PixelClass::lit, ClassReason::none, 1}});
    EXPECT_EQ(lit.false_shadow_rate, 0.0);
    EXPECT_FALSE(lit.false_lit_rate.has_value());
    EXPECT_EQ(lit.error_rate, 0.0);
}

TEST(Measure, AcceptsAnEmptyImage)
{
    EXPECT_EQ(measure(std::vector<MetricsPixel>{}).pixels.total, 0U);
}

TEST(Measure, GivesTheSameBitsWithAnyNumberOfThreads)
{
    // Spans several leaves of the reduction, with verdicts whose sum rounds.
    std::mt19937 random{20};
    std::uniform_real_distribution<float> verdict{0.0F, 1.0F};
    std::vector<MetricsPixel> pixels(300'001);
    for (MetricsPixel& pixel : pixels) {
        pixel = {random() % 2 == 0 ? PixelClass::lit : PixelClass::blocked, ClassReason::none,
                 std::min(verdict(random), 1.0F)};
    }
    const Layers layers = layers_of(pixels);
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control limit{tbb::global_control::max_allowed_parallelism, threads};
        return *analysis::measure(layers.truth, layers.lookup, 0).mean_abs_error;
    };
    const double one = with_threads(1);
    EXPECT_EQ(one, with_threads(2));
    EXPECT_EQ(one, with_threads(7));
}

TEST(Measure, RejectsAScoredVerdictThatIsNoVerdict)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {std::nanf(""), -0.25F, 1.25F, infinity}) {
        EXPECT_THROW((void)measure({{PixelClass::lit, ClassReason::none, 1},
                                    {PixelClass::blocked, ClassReason::none, bad}}),
                     std::domain_error)
            << "verdict = " << bad;
        EXPECT_NO_THROW((void)measure({{PixelClass::attached, ClassReason::none, bad}}));
    }
}

TEST(Measure, NamesTheFirstBadPixel)
{
    std::vector<MetricsPixel> pixels(200'000, MetricsPixel{PixelClass::lit, ClassReason::none, 1});
    pixels[199'999].verdict = std::nanf("");
    pixels[100'003].verdict = std::nanf("");
    try {
        (void)measure(pixels);
        FAIL() << "a NaN verdict was accepted";
    } catch (const std::domain_error& error) {
        EXPECT_NE(std::string{error.what()}.find("pixel 100003 is nan"), std::string::npos)
            << error.what();
    }
}

TEST(Measure, RejectsLayersOfDifferentSize)
{
    Layers layers = layers_of({{PixelClass::lit}, {PixelClass::lit}});
    layers.lookup.samples = scene::Image<scene::LookupSample>{scene::ImageSize{1, 2}};
    EXPECT_THROW((void)analysis::measure(layers.truth, layers.lookup, 0), std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
