#include "methods/job_method.hpp"
#include "methods/key_table.hpp"
#include "methods/taps/tap_kernel.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::methods {
namespace {

using scene::Vec2f;

constexpr TapPattern patterns[]{TapPattern::grid, TapPattern::poisson, TapPattern::vogel,
                                TapPattern::vogel_areas};
constexpr TapWeights all_weights[]{TapWeights::equal, TapWeights::tent, TapWeights::gaussian};

/// The mean of a function of the taps' places, by their weights.
double mean_of(const TapKernel& kernel, const std::function<double(const Vec2f&)>& value)
{
    double sum = 0;
    for (std::size_t i = 0; i < kernel.places.size(); ++i) {
        const double weight = kernel.weights.empty()
                                  ? 1.0 / static_cast<double>(kernel.places.size())
                                  : double{kernel.weights[i]};
        sum += weight * value(kernel.places[i]);
    }
    return sum;
}
double mean_square_x(const TapKernel& kernel)
{
    return mean_of(kernel, [](const Vec2f& place) { return std::pow(double{place.x}, 2); });
}
double mean_square_radius(const TapKernel& kernel)
{
    return mean_of(kernel, [](const Vec2f& place) {
        return std::pow(double{place.x}, 2) + std::pow(double{place.y}, 2);
    });
}

TEST(TapKernels, BeginInTheMiddleAndStayInTheirRadius)
{
    for (const TapPattern pattern : patterns) {
        for (const int taps : {9, 25, 49, 81}) {
            const TapKernel& kernel = tap_kernel(pattern, taps, TapWeights::equal);
            ASSERT_EQ(kernel.places.size(), static_cast<std::size_t>(taps));
            EXPECT_TRUE(kernel.weights.empty());
            if (pattern != TapPattern::vogel_areas) {
                EXPECT_EQ(kernel.places.front(), Vec2f{0});
            }
            const auto from_middle = [](const Vec2f& place) {
                return std::hypot(double{place.x}, double{place.y});
            };
            EXPECT_EQ(std::ranges::min_element(kernel.places, {}, from_middle),
                      kernel.places.begin());
            for (const Vec2f& place : kernel.places) {
                const double x{place.x};
                const double y{place.y};
                const double distance = pattern == TapPattern::grid
                                            ? std::max(std::abs(x), std::abs(y))
                                            : std::sqrt(x * x + y * y);
                EXPECT_LE(distance, 1 + 0x1p-23) << taps;
            }
        }
    }
}

TEST(TapKernels, OfAGridHaveTheVarianceOfSoManyTexels)
{
    for (const int half : {1, 2, 3, 4}) {
        const int taps = (2 * half + 1) * (2 * half + 1);
        // Σ i² over 2h + 1 equal places is h(h + 1)/3 of their mean. 1/3 rounds to 2^-25.
        const double equal = (half + 1) / (3.0 * half);
        EXPECT_NEAR(mean_square_x(tap_kernel(TapPattern::grid, taps, TapWeights::equal)), equal,
                    0x1p-22);
        // Weights h + 1 − |i|: ((h + 1)² − 1)/6. Each of the taps' weights rounds to 2^-17.
        const double tent = ((half + 1) * (half + 1) - 1) / (6.0 * half * half);
        EXPECT_NEAR(mean_square_x(tap_kernel(TapPattern::grid, taps, TapWeights::tent)), tent,
                    taps * 0x1p-17);
    }
}

TEST(TapKernels, OfASpiralHaveTheMeanSquareRadiusOfADisc)
{
    for (const int taps : {4, 9, 32, 81}) {
        // The squares are 0, 1/(n − 1), … 1: as a disc's, evenly. Each place rounds by 2^-25.
        EXPECT_NEAR(mean_square_radius(tap_kernel(TapPattern::vogel, taps, TapWeights::equal)), 0.5,
                    0x1p-22)
            << taps;
        // The squares for the middles of n equal areas are (i + 1/2)/n.
        EXPECT_NEAR(
            mean_square_radius(tap_kernel(TapPattern::vogel_areas, taps, TapWeights::equal)), 0.5,
            0x1p-22)
            << taps;
    }
}

TEST(TapKernels, OfAPoissonDiscKeepApartAndFillIt)
{
    for (const int taps : {4, 16, 25, 64, 81}) {
        const auto& places = tap_kernel(TapPattern::poisson, taps, TapWeights::equal).places;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < places.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                least = std::min(least, std::hypot(double{places[i].x} - double{places[j].x},
                                                   double{places[i].y} - double{places[j].y}));
            }
        }
        // The densest discs of diameter d fill at most π/√12 of the area, whose radius then is 1 +
        // d/2; the best of many candidates come to more than half of that d.
        const double densest = 2 * std::sqrt(0.9069 / taps);
        EXPECT_GT(least, 0.5 * densest) << taps;
        if (taps >= 25) {
            const double square =
                mean_square_radius(tap_kernel(TapPattern::poisson, taps, TapWeights::equal));
            EXPECT_NEAR(square, 0.5, 0.12) << taps;
        }
    }
}

TEST(TapKernels, HaveWholeWeightsWhoseSumIsOne)
{
    for (const TapPattern pattern : patterns) {
        for (const TapWeights weights : {TapWeights::tent, TapWeights::gaussian}) {
            for (const int taps : {9, 25, 81}) {
                const TapKernel& kernel = tap_kernel(pattern, taps, weights);
                ASSERT_EQ(kernel.weights.size(), kernel.places.size());
                EXPECT_EQ(std::reduce(kernel.weights.begin(), kernel.weights.end()), 1.0F);
                for (const float weight : kernel.weights) {
                    EXPECT_GT(weight, 0);
                    EXPECT_EQ(weight * 0x1p16F, std::floor(weight * 0x1p16F));
                    EXPECT_LE(weight, kernel.weights.front());
                }
            }
        }
    }
}

TEST(TapKernels, OfAGaussianFallAsItDoes)
{
    const TapKernel& kernel = tap_kernel(TapPattern::vogel, 25, TapWeights::gaussian);
    for (std::size_t i = 1; i < kernel.places.size(); ++i) {
        const double square =
            std::pow(double{kernel.places[i].x}, 2) + std::pow(double{kernel.places[i].y}, 2);
        // Both weights are rounded to 2^-17, and the middle one absorbs the rounding of 25.
        const double middle{kernel.weights.front()};
        EXPECT_NEAR(double{kernel.weights[i]}, middle * std::exp(-2 * square), 14 * 0x1p-16);
    }
}

TEST(TapKernels, AreTheSameEachTime)
{
    const TapKernel& first = tap_kernel(TapPattern::poisson, 16, TapWeights::equal);
    EXPECT_EQ(&tap_kernel(TapPattern::poisson, 16, TapWeights::equal), &first);
    const TapKernel& longer = tap_kernel(TapPattern::poisson, 25, TapWeights::equal);
    EXPECT_TRUE(std::equal(first.places.begin(), first.places.end(), longer.places.begin()))
        << "one sequence";
}

TEST(TapKernels, RejectNumbersThatTheyCannotHave)
{
    for (const TapPattern pattern : patterns) {
        for (const TapWeights weights : all_weights) {
            for (const int taps : {-1, 0, 1, 3, 82, 100}) {
                EXPECT_THROW((void)tap_kernel(pattern, taps, weights), std::invalid_argument)
                    << taps;
            }
        }
    }
    for (const int taps : {4, 16, 24, 36, 80}) {
        EXPECT_FALSE(is_grid(taps)) << taps;
        EXPECT_THROW((void)tap_kernel(TapPattern::grid, taps, TapWeights::equal),
                     std::invalid_argument);
    }
}

TEST(Rotations, GoEvenlyAroundTheCircle)
{
    ASSERT_EQ(rotations().size(), rotation_count);
    for (std::size_t i = 0; i < rotation_count; ++i) {
        const double angle_rad = 2 * std::acos(-1.0) * static_cast<double>(i) / rotation_count;
        // Half an ulp of float32, and 64 products of doubles.
        EXPECT_NEAR(double{rotations()[i].x}, std::cos(angle_rad), 0x1p-24);
        EXPECT_NEAR(double{rotations()[i].y}, std::sin(angle_rad), 0x1p-24);
    }
}

scene::Job pcf_job(const std::vector<scene::Override>& keys)
{
    std::vector<scene::Override> all{{"method.name", "pcf"}};
    all.insert(all.end(), keys.begin(), keys.end());
    return scene::builtin_job("wall", all, methods::key_table()).job;
}

TEST(PcfTraits, AreOfTheJobsTaps)
{
    const LookupTraits grid = traits(pcf_job({}));
    EXPECT_EQ(grid.width_texels, 5);
    EXPECT_EQ(grid.tap_count(), 25U);
    EXPECT_EQ(grid.equal_taps(), 25);
    EXPECT_EQ(grid.curve, Curve::by_formula);
    EXPECT_FALSE(grid.interpolates());
    EXPECT_TRUE(grid.scatters_taps());
    const LookupTraits weighted =
        traits(pcf_job({{"method.weights", "tent"}, {"method.radius_texels", "3.5"}}));
    EXPECT_EQ(weighted.width_texels, 9);
    EXPECT_EQ(weighted.equal_taps(), 0);
    EXPECT_EQ(weighted.curve, Curve::by_bisection);
    EXPECT_TRUE(weighted.weighs_taps());
    EXPECT_FALSE(weighted.interpolates());
    const LookupTraits metres = traits(pcf_job({{"method.radius_m", "0.5"}}));
    EXPECT_TRUE(metres.taps.is_in_metres);
    EXPECT_EQ(metres.taps.radius, 0.5);
    EXPECT_TRUE(traits(pcf_job({{"method.turned", "true"}})).taps.is_turned);
}

TEST(PcfTraits, OfBilinearTapsHaveFourTexelsEach)
{
    const LookupTraits four = traits(
        pcf_job({{"method.tap", "bilinear"}, {"method.taps", "9"}, {"method.radius_texels", "1"}}));
    EXPECT_EQ(four.tap_count(), 36U);
    EXPECT_EQ(four.width_texels, 5); // 1.5 texels from the middle one's
    EXPECT_EQ(four.equal_taps(), 0);
    EXPECT_TRUE(four.weighs_taps());
    EXPECT_FALSE(four.interpolates());
    EXPECT_EQ(four.curve, Curve::by_bisection);
}

/// The error message for a job.
std::string refusal_of(const std::vector<scene::Override>& keys)
{
    try {
        check(pcf_job(keys));
    } catch (const scene::InputError& error) {
        return error.what();
    }
    return "";
}

TEST(PcfCheck, RefusesInOneLineWhatDoesNotGoTogether)
{
    EXPECT_EQ(refusal_of({{"method.pattern", "vogel"}, {"method.taps", "16"}}), "");
    EXPECT_EQ(refusal_of({{"method.taps", "16"}}),
              "method.taps = 16: a grid has an odd number of taps along each side; use 9, 25, 49 "
              "or 81, or another method.pattern");
    EXPECT_EQ(refusal_of({{"method.taps", "25"}, {"method.tap", "bilinear"}}), "");
    EXPECT_EQ(refusal_of({{"method.taps", "49"}, {"method.tap", "bilinear"}}),
              "method.taps = 49: method.tap = \"bilinear\" allows at most 25, because each "
              "reads four texels; use fewer, or method.tap = \"texel\"");
    EXPECT_EQ(refusal_of({{"method.radius_m", "0.5"},
                          {"shadow_map.layout", "cascades"},
                          {"shadow_map.cascades", "2"},
                          {"shadow_map.blend", "0.2"}}),
              "method.radius_m: a radius in metres differs between two maps that are blended; use "
              "method.radius_texels, or remove shadow_map.blend");
}

TEST(PcfTraits, CanBeAskedOfAJobThatIsRefused)
{
    EXPECT_EQ(traits(pcf_job({{"method.taps", "16"}})).tap_count(), 9U);
}

TEST(PcfKeys, RefuseARadiusOfNothingAndOneOfAThousandTexels)
{
    for (const char* const radius : {"0", "0.1", "65", "1000"}) {
        try {
            (void)pcf_job({{"method.radius_texels", radius}});
            ADD_FAILURE() << radius;
        } catch (const scene::InputError& error) {
            EXPECT_NE(std::string{error.what()}.find("must be a number from 0.25 to 64"),
                      std::string::npos)
                << error.what();
        }
    }
}

} // namespace
} // namespace gnomon::methods
