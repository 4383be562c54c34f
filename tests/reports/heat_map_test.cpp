#include "reports/pictures/heat_map.hpp"

#include "example_comparison.hpp"
#include "scene/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gnomon::reports {
namespace {

using ::testing::HasSubstr;

TEST(ShareOnScale, IsLinearNearZeroAndLogarithmicBeyond)
{
    // A decade is as long as the linear part: 0.01 … 100 are four decades, five lengths in all.
    EXPECT_EQ(share_on_scale(0, 0.01, 100), 0.5);
    EXPECT_DOUBLE_EQ(share_on_scale(0.005, 0.01, 100), 0.5 + 0.5 * 0.5 / 5);
    EXPECT_DOUBLE_EQ(share_on_scale(0.01, 0.01, 100), 0.6);
    EXPECT_DOUBLE_EQ(share_on_scale(1, 0.01, 100), 0.8);
    EXPECT_DOUBLE_EQ(share_on_scale(-1, 0.01, 100), 0.2);
    EXPECT_EQ(share_on_scale(100, 0.01, 100), 1.0);
    EXPECT_EQ(share_on_scale(1e9, 0.01, 100), 1.0);
    EXPECT_EQ(share_on_scale(-std::numeric_limits<double>::infinity(), 0.01, 100), 0.0);
}

TEST(ShareOnScale, GrowsWithTheValue)
{
    std::mt19937 random{7};
    std::uniform_real_distribution<double> exponent{-9, 3};
    for (int i = 0; i < 1000; ++i) {
        const double small = std::pow(10, exponent(random));
        const double large = small * 1.01;
        EXPECT_LE(share_on_scale(small, 1e-6, 1), share_on_scale(large, 1e-6, 1)) << small;
        EXPECT_NEAR(share_on_scale(small, 1e-6, 1) + share_on_scale(-small, 1e-6, 1), 1, 1e-15);
    }
}

TEST(HeatMap, HasANameForEachKind)
{
    for (const std::string_view name : heat_map_names()) {
        EXPECT_TRUE(heat_map_from_name(name).has_value()) << name;
    }
    EXPECT_FALSE(heat_map_from_name("needed_bias").has_value());
    EXPECT_FALSE(heat_map_from_name("").has_value());
}

/// The example, with given causes and depth errors.
analysis::Comparison diagnosed()
{
    analysis::Comparison comparison = store::example().comparison;
    const scene::ImageSize size = comparison.truth.pixel_class.size();
    analysis::Diagnosis diagnosis;
    diagnosis.map_error_m = scene::Image<float>{size, std::numeric_limits<float>::quiet_NaN()};
    diagnosis.map_error_m(40, 30) = -2; // beyond the scale
    diagnosis.causes.cause = scene::Image<analysis::Cause>{size, analysis::Cause::none};
    diagnosis.causes.label = scene::Image<analysis::Label>{size, analysis::Label::none};
    comparison.diagnosis = std::move(diagnosis);
    return comparison;
}

std::size_t pixels_of(const store::RgbImage& image, store::Rgb colour)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        count += image[i] == colour ? 1U : 0U;
    }
    return count;
}

TEST(HeatMap, ShowsTheSameColourForTheSameValue)
{
    analysis::Comparison comparison = diagnosed();
    const store::Rgb deepest_blue{0x08, 0x30, 0x6B};
    const std::size_t one =
        pixels_of(draw_heat_map(comparison, HeatMap::depth_error), deepest_blue);
    comparison.diagnosis->map_error_m(41, 30) = -1;
    comparison.diagnosis->map_error_m(42, 30) = 1;
    const std::size_t two =
        pixels_of(draw_heat_map(comparison, HeatMap::depth_error), deepest_blue);
    // A pixel of a small image is a square of the picture; the legend's bar may contain its colour.
    const std::size_t square = two - one;
    EXPECT_GT(square, 1U);
    EXPECT_EQ(std::lround(std::sqrt(square)) * std::lround(std::sqrt(square)),
              static_cast<long>(square));
    EXPECT_GE(one, square);
}

TEST(HeatMap, SaysWhatItDoesNotKnow)
{
    const auto refusal = [](const analysis::Comparison& comparison, HeatMap kind) {
        try {
            (void)draw_heat_map(comparison, kind);
        } catch (const scene::InputError& error) {
            return std::string{error.what()};
        }
        return std::string{"drawn"};
    };
    EXPECT_THAT(refusal(store::example().comparison, HeatMap::cause), HasSubstr("--truth float"));
    EXPECT_THAT(refusal(diagnosed(), HeatMap::needed_bias), HasSubstr("no bias curve"));
    EXPECT_EQ(refusal(diagnosed(), HeatMap::label), "drawn");
}

} // namespace
} // namespace gnomon::reports
