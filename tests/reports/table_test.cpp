#include "reports/tables/comparison_table.hpp"

#include "example_comparison.hpp"
#include "reports/text/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace gnomon::reports {
namespace {

using scene::ClassReason;
using testing::HasSubstr;
using testing::Not;

analysis::Comparison with_counts()
{
    static const store::Example example;
    analysis::Comparison comparison = example.comparison;
    analysis::Metrics& metrics = comparison.metrics;
    metrics.pixels.total = 921'600;
    metrics.pixels.by_class = {400'000, 123, 1'000, 0, 7, 500'000, 20'470};
    metrics.pixels.by_reason = {};
    metrics.pixels.by_reason[static_cast<std::size_t>(ClassReason::snap)] = 120;
    metrics.pixels.by_reason[static_cast<std::size_t>(ClassReason::tie)] = 3;
    metrics.pixels.by_reason[static_cast<std::size_t>(ClassReason::vertex)] = 7;
    metrics = make_metrics(metrics.pixels, {5'000, 2'047, {5'000, 2'047, 0, 0}});
    return comparison;
}

TEST(ComparisonTable, AlignsCountsRatesAndDenominators)
{
    const std::string table = comparison_table(with_counts());
    EXPECT_THAT(table, HasSubstr("class                  pixels      share\n"
                                 "background            400,000     43.4 %\n"
                                 "unmatched                 123   0.0133 %  snap 120, tie 3\n"
                                 "attached                1,000    0.109 %\n"
                                 "out_of_light                0        0 %\n"
                                 "indeterminate               7   0.0008 %  vertex 7\n"
                                 "lit                   500,000     54.3 %  scored\n"
                                 "blocked                20,470     2.22 %  scored\n"
                                 "total                 921,600\n"));
    EXPECT_THAT(table,
                HasSubstr("error                  pixels       rate\n"
                          "false shadow            5,000     1.00 %  of 500,000 lit\n"
                          "false lit               2,047     10.0 %  of 20,470 blocked\n"
                          "both                    7,047     1.35 %  of 520,470 scored\n\n"));
}

TEST(ComparisonTable, AddsAmountsWhereVerdictsAreFractions)
{
    analysis::Comparison comparison = with_counts();
    comparison.metrics =
        make_metrics(comparison.metrics.pixels, {5'000, 2'047, {7'500.4, 12.34, 9'000, 0}});
    EXPECT_THAT(comparison_table(comparison),
                HasSubstr("amount                 pixels       rate\n"
                          "false shadow            7,500     1.50 %  dark where lit\n"
                          "false light              12.3   0.0603 %  lit where blocked\n"
                          "both                    7,513     1.44 %  mean |verdict - truth|\n"
                          "partial                 9,000             right by side, wrong by "
                          "amount\n"));
}

TEST(ComparisonTable, NamesSceneSettingsAndEnvironment)
{
    const std::string table = comparison_table(with_counts());
    EXPECT_THAT(table, HasSubstr("scene           example.obj\n                "));
    EXPECT_THAT(table, HasSubstr("shadow map      48x48 d24, fit scene\n"));
    EXPECT_THAT(table, HasSubstr("lookup          nearest, outside lit\n"));
    EXPECT_THAT(table, HasSubstr("bias            constant 0.002, slope 0, normal 0 texels\n"));
    EXPECT_THAT(table, HasSubstr("truth           exact, Embree 3.13.5\n"));
    EXPECT_THAT(table, HasSubstr("seconds         scene "));
}

TEST(ComparisonTable, TellsHowLongAPolygonOffsetIs)
{
    analysis::Comparison comparison = with_counts();
    EXPECT_THAT(comparison_table(comparison), Not(HasSubstr("polygon offset")));
    const auto lengths = [](float median, float p95) {
        const analysis::Quantiles spread{.median = median, .p95 = p95};
        return analysis::OffsetLengths{spread, spread, spread};
    };
    comparison.drawn_offset = {.offset = {2, 0.5F, 0},
                               .r = {.median = 0x1p-4F},
                               .of_factor = lengths(0.25F, 0.5F),
                               .of_units = lengths(0.125F, 0.125F),
                               .whole = lengths(0.375F, 0.625F)};
    EXPECT_THAT(comparison_table(comparison),
                HasSubstr("polygon offset  factor 2: 0.25, 0.25 units, 0.25 texels; 95 % up to "
                          "0.5 units\n"
                          "                units 0.5 of r 0.0625: 0.125, 0.125 units, 0.125 "
                          "texels; 95 % up to 0.125 units\n"
                          "                both: 0.375, 0.375 units, 0.375 texels; 95 % up to "
                          "0.625 units\n"));
}

TEST(ComparisonTable, ShowsTheNotesOnTheScene)
{
    analysis::Comparison comparison = with_counts();
    comparison.scene.notes = {};
    EXPECT_THAT(comparison_table(comparison), testing::Not(HasSubstr("\nnote ")));
    comparison.scene.notes = {{"alpha_mask", 2, "2 materials are cut out"}, {"a", 1, "another"}};
    EXPECT_THAT(comparison_table(comparison),
                HasSubstr("\nnote            2 materials are cut out\n                another\n"));
}

TEST(ComparisonTable, ShowsADashForARateWithoutADenominator)
{
    analysis::Comparison comparison = with_counts();
    comparison.metrics = {};
    EXPECT_THAT(comparison_table(comparison),
                HasSubstr("false lit                   0          -  of 0 blocked\n"));
}

/// The lines of a table whose best biases are from `lo` to `hi`.
std::string with_best_biases(float lo, float hi)
{
    analysis::Comparison comparison = with_counts();
    comparison.diagnosis.emplace();
    comparison.diagnosis->biases.emplace(analysis::BiasAnswers{
        .critical_bias = {},
        .curve = {scene::Image<float>{{1, 1}}, scene::Image<scene::PixelClass>{{1, 1}}},
        .best = {.interval = {lo, hi}, .errors = {}},
        .bounds = {},
        .map = {},
        .slopes = {}});
    return comparison_table(comparison);
}

TEST(ComparisonTable, TellsAnIntervalOfBiasesByTheEndsThatItHas)
{
    constexpr float none = std::numeric_limits<float>::infinity();
    EXPECT_THAT(with_best_biases(0.002F, 0.003F),
                HasSubstr("fewest errors (0) from 0.002 to 0.003\n"));
    EXPECT_THAT(with_best_biases(-none, -0.1687F),
                HasSubstr("fewest errors (0) with -0.1687 or less\n"));
    EXPECT_THAT(with_best_biases(0.5F, none), HasSubstr("fewest errors (0) with 0.5 or more\n"));
    EXPECT_THAT(with_best_biases(-none, none), HasSubstr("fewest errors (0) with any bias\n"));
}

TEST(ComparisonTable, ShowsNoMinusBeforeZero)
{
    EXPECT_THAT(with_best_biases(-0.0F, 0.5F), HasSubstr("fewest errors (0) from 0 to 0.5\n"));
    analysis::Comparison comparison = with_counts();
    comparison.view.bias = {-0.0F, -0.0F, -0.0F};
    EXPECT_THAT(comparison_table(comparison), HasSubstr("constant 0, slope 0, normal 0 texels"));
}

TEST(ComparisonTable, IsNarrowAndHasNoTrailingBlanks)
{
    std::istringstream lines{comparison_table(with_counts())};
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(text_columns(line), 80U) << line;
        EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
    }
}

} // namespace
} // namespace gnomon::reports
