#include "analysis/results/metric_table.hpp"
#include "analysis/results/results.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace gnomon::analysis {
namespace {

using scene::PixelClass;

/// A result of 100 pixels; the others are background.
ConfigurationResult result_with(std::uint64_t lit, std::uint64_t blocked, VerdictErrors errors)
{
    ClassCounts pixels;
    pixels.total = 100;
    pixels.by_class[static_cast<std::size_t>(PixelClass::lit)] = lit;
    pixels.by_class[static_cast<std::size_t>(PixelClass::blocked)] = blocked;
    pixels.by_class[static_cast<std::size_t>(PixelClass::background)] = 100 - lit - blocked;
    ConfigurationResult result;
    result.metrics = make_metrics(pixels, errors);
    result.causes.emplace();
    result.causes->by_cause[static_cast<std::size_t>(Cause::bias)] = errors.false_lit;
    result.causes->by_label[static_cast<std::size_t>(Label::acne)] = errors.false_shadow;
    result.amounts.by_cause[static_cast<std::size_t>(Cause::filter)] = 0.25;
    result.amounts.shadow_softening = 0.5;
    result.peter_panning.metres = Quantiles{3, 1, 2, 4, 5};
    result.cells.resize(1);
    return result;
}

TEST(TotalOf, CountsEveryPairOfPixelAndLight)
{
    const std::vector<ConfigurationResult> lights{
        result_with(60, 20, {6, 2, {6.5, 2.25, 1, 0.125}}),
        result_with(20, 0, {4, 0, {4, 0, 0, 0}})};
    const ConfigurationResult total = total_of(lights);
    EXPECT_EQ(total.metrics.pixels.total, 200U);
    EXPECT_EQ(total.metrics.pixels.of(PixelClass::lit), 80U);
    EXPECT_EQ(total.metrics.pixels.of(PixelClass::background), 100U);
    EXPECT_EQ(total.metrics.false_shadow, 10U);
    EXPECT_EQ(total.metrics.false_lit, 2U);
    EXPECT_EQ(total.metrics.false_shadow_rate, 10.0 / 80);
    EXPECT_EQ(total.metrics.false_lit_rate, 2.0 / 20);
    EXPECT_EQ(total.metrics.error_rate, 12.0 / 100);
    EXPECT_EQ(total.metrics.amounts.shadow, 10.5);
    EXPECT_EQ(total.metrics.amounts.light, 2.25);
    EXPECT_EQ(total.metrics.amounts.partial, 1U);
    EXPECT_EQ(total.metrics.amounts.unassigned, 0.125);
    EXPECT_EQ(total.metrics.shadow_amount_rate, 10.5 / 80);
    EXPECT_EQ(total.metrics.mean_abs_error, 12.75 / 100);
    ASSERT_TRUE(total.causes);
    EXPECT_EQ(total.causes->of(Cause::bias), 2U);
    EXPECT_EQ(total.causes->of(Label::acne), 10U);
    EXPECT_EQ(total.amounts.of(Cause::filter), 0.5);
    EXPECT_EQ(total.amounts.softening(), 1.0);
}

TEST(TotalOf, LeavesOutWhatAddsUpToNothing)
{
    std::vector<ConfigurationResult> lights{result_with(60, 20, {}), result_with(20, 0, {})};
    ASSERT_TRUE(total_of(lights).peter_panning.metres);
    EXPECT_EQ(total_of(lights).peter_panning.metres->count, 6U);
    for (const auto& metric : configuration_metrics()) {
        const auto value = metric.value(total_of(lights));
        if (metric.name == "peter_panning_gap_pixels") {
            EXPECT_EQ(value, MetricValue{std::uint64_t{6}});
        } else if (metric.name.starts_with("peter_panning_gap")) {
            EXPECT_EQ(value, MetricValue{}) << metric.name;
        }
    }
    EXPECT_TRUE(total_of(lights).cells.empty());
    lights.back().causes.reset();
    EXPECT_FALSE(total_of(lights).peter_panning.metres);
    EXPECT_FALSE(total_of(lights).causes);
    EXPECT_EQ(total_of(lights).amounts.softening(), 0.0);
}

TEST(TotalOf, OneLightIsItsOwn)
{
    const std::vector<ConfigurationResult> light{
        result_with(60, 20, {6, 2, {6.5, 2.25, 1, 0.125}})};
    const ConfigurationResult total = total_of(light);
    EXPECT_EQ(total.metrics.error_rate, light[0].metrics.error_rate);
    EXPECT_EQ(total.metrics.amounts, light[0].metrics.amounts);
}

TEST(TotalOf, NothingScoredHasNoRates)
{
    const std::vector<ConfigurationResult> lights{result_with(0, 0, {}), result_with(0, 0, {})};
    EXPECT_FALSE(total_of(lights).metrics.error_rate);
}

} // namespace
} // namespace gnomon::analysis
