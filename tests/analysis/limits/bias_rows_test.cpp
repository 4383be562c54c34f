// Checks counts at many biases from one lookup, against counting each bias separately.

#include "analysis/limits/bias_rows.hpp"

#include "analysis/metrics/peter_panning_gaps.hpp"

#include "analysis/bias/amount_rows.hpp"
#include "analysis/lookup/bias_order.hpp"
#include "analysis/metrics/metrics.hpp"
#include "lane.hpp"
#include "lookup_case.hpp"
#include "random_biases.hpp"
#include "scene/infinity.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::infinity;
using scene::Outside;
using scene::PixelClass;
using test::random_biases;
using test::random_depth;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const float nan = std::nanf("");

/// One lookup, with classes and causes of its pixels.
struct Subject {
    scene::Image<PixelClass> classes;
    scene::LookupLayers deciding;
    PixelCauses causes;
    LookupRule rule;

    explicit Subject(scene::ImageSize size)
        : classes{size},
          deciding{scene::Image<scene::LookupSample>{size}, scene::Image<scene::Vec2f>{size}},
          causes{scene::Image<PixelCause>{size}, {}}
    {
    }
    [[nodiscard]] std::vector<BiasRow> rows(const std::vector<float>& biases) const
    {
        const auto critical = critical_biases(deciding, rule);
        const BiasCurve curve{critical, classes};
        return count_rows({classes, deciding, critical, causes, rule}, curve,
                          sum_amounts(curve, biases), biases);
    }
};

/// The cause of a wrong pixel, following the definition.
/// @param bias  Sum of constant and slope bias, as the lookup adds them.
Cause cause_of(const PixelCause& pixel, PixelClass truth, float bias)
{
    if (pixel.if_wrong == Cause::none) {
        return Cause::bias;
    }
    return truth == PixelClass::lit && bias >= pixel.exact_critical_bias ? Cause::precision
                                                                         : pixel.if_wrong;
}

/// Counts one bias by the definition: verdict, cause and label of every pixel.
BiasRow count_row(const Subject& subject, float bias)
{
    BiasRow row;
    for (std::size_t i = 0; i < subject.classes.pixel_count(); ++i) {
        const PixelClass truth = subject.classes[i];
        const scene::LookupSample& sample = subject.deciding.samples[i];
        const float whole = bias + subject.rule.slope * sample.tan_theta;
        bool is_lit = subject.rule.reversed ? sample.receiver_depth + whole >= sample.map_depth
                                            : sample.receiver_depth - whole <= sample.map_depth;
        if (std::isnan(sample.map_depth)) {
            is_lit = subject.rule.outside == Outside::lit;
        }
        if (!scene::is_scored(truth) || is_lit == (truth == PixelClass::lit)) {
            continue;
        }
        ++(is_lit ? row.errors.false_lit : row.errors.false_shadow);
        const PixelCause& why = subject.causes.pixels[i];
        const Cause cause = cause_of(why, truth, whole);
        const double own = why.sees ? 1 : 0;
        const Label label = truth == PixelClass::lit ? label_of_lit(cause, {own, 1 - own})
                                                     : label_of_blocked(cause, why.sees);
        ++row.causes.by_cause[static_cast<std::size_t>(cause)];
        ++row.causes.by_label[static_cast<std::size_t>(label)];
    }
    return row;
}

std::string text_of(const BiasRow& row)
{
    return fmt::format("{} {} | {} {} {} {} | {} {} {} {} {}", row.errors.false_shadow,
                       row.errors.false_lit, row.causes.of(Cause::bias),
                       row.causes.of(Cause::precision), row.causes.of(Cause::resolution),
                       row.causes.of(Cause::coverage), row.causes.of(Label::acne),
                       row.causes.of(Label::peter_panning), row.causes.of(Label::leak),
                       row.causes.of(Label::edge), row.causes.of(Label::overshadow));
}

TEST(BiasRows, CountAPixelOnEitherSideOfItsCriticalBias)
{
    Subject subject{{2, 1}};
    // r − b <= d from b = 0.5 on; the difference is exact there.
    subject.classes[0] = PixelClass::lit;
    subject.deciding.samples[0] = {0.75F, 0.25F, 0, 0};
    subject.causes.pixels[0] = {Cause::resolution, Cause::resolution, true, 0.125F};
    subject.classes[1] = PixelClass::blocked;
    subject.deciding.samples[1] = {0.75F, 0.25F, 0, 0};
    const std::vector<float> biases{0.0F, 0.125F, previous_bias(0.5F), 0.5F, 1.0F};
    const auto rows = subject.rows(biases);
    ASSERT_EQ(rows.size(), biases.size());
    EXPECT_EQ(text_of(rows[0]), "1 0 | 0 0 1 0 | 1 0 0 0 0");
    // Exact depths suffice from 0.125 on.
    EXPECT_EQ(text_of(rows[1]), "1 0 | 0 1 0 0 | 1 0 0 0 0");
    EXPECT_EQ(text_of(rows[2]), "1 0 | 0 1 0 0 | 1 0 0 0 0");
    EXPECT_EQ(text_of(rows[3]), "0 1 | 1 0 0 0 | 0 1 0 0 0");
    EXPECT_EQ(text_of(rows[4]), "0 1 | 1 0 0 0 | 0 1 0 0 0");
}

TEST(BiasRows, CountBorderPixelsAtEveryBias)
{
    Subject subject{{2, 1}};
    subject.classes[0] = PixelClass::lit;
    subject.classes[1] = PixelClass::blocked;
    for (std::size_t i = 0; i < 2; ++i) {
        subject.deciding.samples[i] = {0.5F, nan, 0, 0};
        subject.causes.pixels[i] = {Cause::coverage, Cause::coverage, false, infinity};
    }
    const std::vector<float> biases{bias_of_rank(-largest_bias_rank), -1, 0, 1,
                                    bias_of_rank(largest_bias_rank)};
    for (const BiasRow& row : subject.rows(biases)) {
        EXPECT_EQ(text_of(row), "0 1 | 0 0 0 1 | 0 0 1 0 0");
    }
    subject.rule.outside = Outside::shadowed;
    for (const BiasRow& row : subject.rows(biases)) {
        EXPECT_EQ(text_of(row), "1 0 | 0 0 0 1 | 0 0 0 0 1");
    }
}

TEST(BiasRows, OfNoBiasAreNone)
{
    const Subject subject{{2, 1}};
    EXPECT_THAT(subject.rows({}), IsEmpty());
    EXPECT_THAT(find_gaps_at({}, {}, {}), IsEmpty());
}

Subject random_subject(std::mt19937& random)
{
    Subject subject{{1 + static_cast<int>(random() % 9), 1 + static_cast<int>(random() % 7)}};
    constexpr std::array<float, 4> slopes{0.0F, 0.0F, 0.0625F, -0.1F};
    subject.rule = rule_of(scene::Filter::nearest, static_cast<Outside>(random() % 3),
                           random() % 2 == 0, slopes.at(random() % 4));
    constexpr std::array<PixelClass, 4> classes{PixelClass::lit, PixelClass::blocked,
                                                PixelClass::attached, PixelClass::background};
    for (std::size_t i = 0; i < subject.classes.pixel_count(); ++i) {
        subject.classes[i] = classes.at(random() % 5 == 0 ? random() % 4 : random() % 2);
        const bool is_border = subject.rule.outside != Outside::clamp && random() % 8 == 0;
        subject.deciding.samples[i] = {random_depth(random), is_border ? nan : random_depth(random),
                                       static_cast<float>(random() % 5) * 0.75F, 0};
        if (random() % 10 == 0) {
            // Depths whose differences round.
            subject.deciding.samples[i].receiver_depth =
                std::ldexp(static_cast<float>(random()), -32);
        }
        // A lit pixel that V1 shadows never has the cause `precision`, at any bias.
        constexpr std::array<Cause, 4> causes{Cause::none, Cause::resolution, Cause::coverage,
                                              Cause::precision};
        const bool is_blocked = subject.classes[i] == PixelClass::blocked;
        const std::array<float, 5> exact{-infinity, infinity, 0.0F, random_depth(random),
                                         -random_depth(random)};
        const Cause cause = causes.at(random() % (is_blocked ? 4 : 3));
        const bool sees = random() % 2 == 0;
        subject.causes.pixels[i] = {cause, cause, sees, exact.at(random() % 5)};
    }
    return subject;
}

TEST(BiasRows, AgreeWithCountingEachBiasByItself)
{
    std::mt19937 random{31};
    for (int round = 0; round < tests::in_lane(500, 1500); ++round) {
        const Subject subject = random_subject(random);
        const auto critical = critical_biases(subject.deciding, subject.rule);
        std::vector<float> criticals{critical.begin(), critical.end()};
        for (const PixelCause& cause : subject.causes.pixels) {
            criticals.push_back(cause.exact_critical_bias);
        }
        const auto biases = random_biases(random, criticals);
        const auto rows = subject.rows(biases);
        ASSERT_EQ(rows.size(), biases.size());
        for (std::size_t i = 0; i < biases.size(); ++i) {
            ASSERT_EQ(text_of(rows[i]), text_of(count_row(subject, biases[i])))
                << "round " << round << ", bias " << biases[i] << ", slope " << subject.rule.slope
                << (subject.rule.reversed ? ", reversed" : "");
        }
    }
}

TEST(BiasRows, RejectBiasesThatDoNotAscend)
{
    const Subject subject{{1, 1}};
    for (const std::vector<float>& biases :
         {std::vector<float>{1.0F, 0.5F}, {0.5F, 0.5F}, {-0.0F, 0.0F}}) {
        EXPECT_THROW((void)subject.rows(biases), std::invalid_argument);
        EXPECT_THROW((void)find_gaps_at({}, biases, {}), std::invalid_argument);
    }
}

TEST(BiasRows, RejectImagesOfDifferentSizes)
{
    const Subject subject{{2, 1}};
    const Subject other{{1, 2}};
    const scene::Image<float> critical{{2, 1}};
    const scene::Image<float> turned{{1, 2}};
    const BiasCurve curve{critical, subject.classes};
    const std::vector<float> biases{0.0F};
    const auto amounts = sum_amounts(curve, biases);
    const auto count = [&](const BiasRowInputs& inputs) {
        return count_rows(inputs, curve, amounts, biases);
    };
    EXPECT_THROW((void)count({other.classes, subject.deciding, critical, subject.causes, {}}),
                 std::invalid_argument);
    EXPECT_THROW((void)count({subject.classes, other.deciding, critical, subject.causes, {}}),
                 std::invalid_argument);
    EXPECT_THROW((void)count({subject.classes, subject.deciding, turned, subject.causes, {}}),
                 std::invalid_argument);
    EXPECT_THROW((void)count({subject.classes, subject.deciding, critical, other.causes, {}}),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
