#include "methods/depth/depth_map.hpp"
#include "methods/glsl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <set>
#include <stdexcept>
#include <string_view>

/// Filters: their kernels, and the monotonicity of `hardware`: a mean of 2 × 2 comparisons never
/// falls when one of them turns from shadowed to lit, however a driver computes it in float32.

namespace gnomon::methods {
namespace {

using scene::Filter;

constexpr Monotonicity exactly{Monotone::exactly, 0};

struct ExpectedFilter {
    Filter filter;
    int width_texels;
    Compares compares;
    Weights weights;
    Curve curve;
    bool has_fractions;
    bool interpolates;
    bool returns_deciding_depth;
    int equal_taps;
    int kernel_texels = 1;
};

constexpr ExpectedFilter expected_filters[]{
    {Filter::nearest, 1, Compares::each_tap, Weights::equal, Curve::by_formula, false, false, true,
     1},
    {Filter::linear, 2, Compares::mean_depth, Weights::bilinear, Curve::by_formula, false, true,
     true, 1},
    {Filter::hardware, 2, Compares::each_tap, Weights::bilinear_of_gl, Curve::by_bisection, true,
     true, false, 0},
    {Filter::pcf3, 3, Compares::each_tap, Weights::equal, Curve::by_formula, true, false, false, 9},
    {Filter::pcf5, 5, Compares::each_tap, Weights::equal, Curve::by_formula, true, false, false,
     25},
    {Filter::pcf7, 7, Compares::each_tap, Weights::equal, Curve::by_formula, true, false, false,
     49},
    {Filter::pcf9, 9, Compares::each_tap, Weights::equal, Curve::by_formula, true, false, false,
     81},
    {Filter::bilinear3, 4, Compares::each_tap, Weights::bilinear, Curve::by_bisection, true, true,
     false, 0, 3},
    {Filter::bilinear5, 6, Compares::each_tap, Weights::bilinear, Curve::by_bisection, true, true,
     false, 0, 5},
    {Filter::bilinear7, 8, Compares::each_tap, Weights::bilinear, Curve::by_bisection, true, true,
     false, 0, 7},
};

TEST(FilterTraits, AreThoseOfTheTable)
{
    ASSERT_EQ(filters().size(), std::size(expected_filters));
    for (const ExpectedFilter& expected : expected_filters) {
        SCOPED_TRACE(scene::filter_name(expected.filter));
        const LookupTraits& promised = filter_traits(expected.filter);
        EXPECT_EQ(promised.width_texels, expected.width_texels);
        EXPECT_EQ(promised.compares, expected.compares);
        EXPECT_EQ(promised.weights, expected.weights);
        EXPECT_EQ(promised.monotonicity, exactly);
        EXPECT_EQ(promised.curve, expected.curve);
        EXPECT_TRUE(promised.has_curve());
        EXPECT_EQ(promised.has_formula(), expected.curve == Curve::by_formula);
        EXPECT_EQ(promised.has_fractions(), expected.has_fractions);
        EXPECT_TRUE(promised.has_exact_causes());
        EXPECT_EQ(promised.is_made_of_taps(), expected.compares == Compares::each_tap);
        EXPECT_EQ(promised.kernel.width_texels(), expected.kernel_texels);
        EXPECT_EQ(promised.interpolates(), expected.interpolates);
        EXPECT_EQ(promised.returns_deciding_depth(), expected.returns_deciding_depth);
        EXPECT_EQ(promised.equal_taps(), expected.equal_taps);
    }
}

TEST(FilterTraits, CountTheTapsOfASquare)
{
    std::size_t most = 0;
    for (const FilterChoice& choice : filters()) {
        const LookupTraits& promised = filter_traits(choice.filter);
        const auto width = static_cast<std::size_t>(promised.width_texels);
        EXPECT_EQ(promised.tap_count(), width * width);
        EXPECT_EQ(promised.has_one_tap(), width == 1);
        most = std::max(most, promised.tap_count());
    }
    EXPECT_EQ(most, 81U);
    EXPECT_LE(most, most_taps);
}

TEST(FilterTraits, AreInTheOrderOfTheEnumeratorsAndHaveASentenceEach)
{
    ASSERT_EQ(filters().size(), scene::filter_count);
    std::set<std::string_view> sentences;
    for (std::size_t i = 0; i < filters().size(); ++i) {
        const auto filter = static_cast<Filter>(i);
        EXPECT_EQ(filters()[i].filter, filter);
        EXPECT_TRUE(sentences.insert(filters()[i].sentence).second) << filters()[i].sentence;
        EXPECT_FALSE(filters()[i].sentence.empty());
    }
}

TEST(FilterTraits, RejectWhatIsNoFilter)
{
    constexpr auto none = static_cast<Filter>(scene::filter_count);
    EXPECT_THROW((void)filter_traits(none), std::out_of_range);
    EXPECT_THROW((void)filter_passes(none), std::out_of_range);
}

/// The n-th moment of a kernel about its middle.
double moment(const Kernel& kernel, int n)
{
    double sum = 0;
    double all = 0;
    for (std::size_t i = 0; i < kernel.weights.size(); ++i) {
        const double from_middle = static_cast<double>(i) - (kernel.width_texels() - 1) / 2.0;
        sum += double{kernel.weights[i]} * std::pow(from_middle, n);
        all += double{kernel.weights[i]};
    }
    return sum / all;
}

TEST(KernelsOfBilinearFilters, AreSymmetricAndHaveTheVarianceOfTheirWeights)
{
    const auto kernel = [](Filter filter) { return filter_traits(filter).kernel; };
    for (const Filter filter : {Filter::bilinear3, Filter::bilinear5, Filter::bilinear7}) {
        EXPECT_EQ(moment(kernel(filter), 1), 0) << scene::filter_name(filter);
        EXPECT_EQ(moment(kernel(filter), 3), 0) << scene::filter_name(filter);
    }
    // Σ i²·w / Σ w: 2/4, 14/12 and 82/52.
    EXPECT_EQ(moment(kernel(Filter::bilinear3), 2), 2 / 4.0);
    EXPECT_EQ(moment(kernel(Filter::bilinear5), 2), 14 / 12.0);
    EXPECT_EQ(moment(kernel(Filter::bilinear7), 2), 82 / 52.0);
}

TEST(FilterPasses, NameAPieceOfGlslThatGivesTheVerdict)
{
    for (const FilterChoice& choice : filters()) {
        EXPECT_NE(
            filter_passes(choice.filter)
                .lookup.glsl.find(
                    "float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)"),
            std::string_view::npos)
            << scene::filter_name(choice.filter);
    }
    EXPECT_THROW((void)glsl_source("none.glsl"), std::invalid_argument);
}

TEST(FilterPasses, LookTheMapItselfUp)
{
    for (const FilterChoice& choice : filters()) {
        const Passes passes = filter_passes(choice.filter);
        EXPECT_TRUE(passes.prefilter.empty()) << scene::filter_name(choice.filter);
        EXPECT_EQ(passes.sampling, choice.filter == Filter::linear     ? Sampling::interpolated
                                   : choice.filter == Filter::hardware ? Sampling::compared
                                                                       : Sampling::fetched)
            << scene::filter_name(choice.filter);
    }
}

using Taps = std::array<float, 4>; ///< (0,0) (1,0) (0,1) (1,1): 0 or 1 each

/// As computed by Mesa's llvmpipe.
float interpolated(const Taps& taps, float x, float y)
{
    const auto between = [](float a, float b, float weight) { return a + weight * (b - a); };
    return between(between(taps[0], taps[1], x), between(taps[2], taps[3], x), y);
}

/// As written in GL's specification.
float summed(const Taps& taps, float x, float y)
{
    return (1 - x) * (1 - y) * taps[0] + x * (1 - y) * taps[1] + (1 - x) * y * taps[2] +
           x * y * taps[3];
}

TEST(BilinearComparison, NeverFallsWhenATapIsLit)
{
    std::mt19937 random{1};
    for (int i = 0; i < 250'000; ++i) {
        // Fractions with this many bits, mostly near 0, ½ or 1, where an error would show.
        const std::uint_fast32_t all = 1U << (8 + random() % 16);
        const auto fraction = [&] {
            const std::uint_fast32_t near = random() % 32;
            const std::array<std::uint_fast32_t, 4> choices{random() % all, all / 2 - near,
                                                            all - 1 - near, near};
            return static_cast<float>(choices.at(random() % 4)) / static_cast<float>(all);
        };
        const float x = fraction();
        const float y = fraction();
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        std::shuffle(order.begin(), order.end(), random);
        Taps taps{};
        for (const std::size_t next : order) {
            const float before = interpolated(taps, x, y);
            const float sum_before = summed(taps, x, y);
            taps.at(next) = 1;
            ASSERT_GE(interpolated(taps, x, y), before) << "x " << x << " y " << y;
            ASSERT_GE(summed(taps, x, y), sum_before) << "x " << x << " y " << y;
        }
    }
}

} // namespace

} // namespace gnomon::methods
