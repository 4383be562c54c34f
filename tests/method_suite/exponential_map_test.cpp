// Exponential shadow maps against their formula in double, and in closed form.

#include "blur_model.hpp"
#include "method_case.hpp"
#include "methods/list.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

struct EsmCase {
    BlurChoice blur;
    double exponent = 80;
    bool is_16_bit = false;
    bool reversed = false;

    [[nodiscard]] std::vector<scene::Override> keys() const
    {
        return with(with(model_keys("esm"), blur.keys()),
                    {{"method.exponent", fmt::format("{}", exponent)},
                     {"method.bits", is_16_bit ? "16" : "32"},
                     {"shadow_map.reversed", reversed ? "true" : "false"}});
    }
    /// Greater is farther.
    [[nodiscard]] double distance(double depth) const { return reversed ? -depth : depth; }
    [[nodiscard]] BlurModel model(const scene::Image<float>& depths) const
    {
        return {depths, blur, [this](double z) { return std::exp(exponent * distance(z)); },
                [this](double mean) { return std::log(mean) / exponent; }};
    }
    /// The error of the map's values over two passes. The exponential of a depth difference x errs
    /// by a relative (3.5·|x| + 4)·2^-24, including its product. |x|·e^(−|x|) is at most 1/e, so a
    /// weighted sum errs by 5.3·2^-24 and (w + 9)/2 roundings. The farthest depth's exponential is
    /// 1, so the sum is at least the kernel's least weight. The logarithm rounds by 2^-22 and is
    /// divided by c; depths of up to 1 round by 2^-24 twice. Half floats have 11 bits, and drivers
    /// may truncate.
    [[nodiscard]] double error_of_mean() const
    {
        const double least_weight = std::string{blur.kernel} == "box" ? 1.0 / blur.width_texels
                                    : blur.width_texels == 9          ? 1.0 / 256
                                                                      : 1.0 / 64;
        const double of_sum = (5.3 + (blur.width_texels + 9) / 2.0) * 0x1p-24 / least_weight;
        const double of_pass = (of_sum + 0x1p-22) / exponent + 0x1p-23;
        return 2 * (of_pass + (is_16_bit ? 0x1p-10 : 0)) + 0x1p-22;
    }
};

void expect_formula(const EsmCase& tried, MethodCase& c, const BlurModel& model)
{
    std::size_t fractions = 0;
    for (const InnerPixel& pixel : inner_pixels(c, tried.blur.reach_texels())) {
        const double off =
            tried.error_of_mean() + interpolation_error() * model.spread_at(pixel.texel) + 0x1p-24;
        const double power =
            tried.exponent * (model.at(pixel.texel) - tried.distance(pixel.receiver_depth));
        // The error of the last exponential, including its product.
        const double rounding = (3.5 * std::abs(power) + 4) * 0x1p-24;
        const double low = std::exp(power - tried.exponent * off) * (1 - rounding);
        const double high = std::exp(power + tried.exponent * off) * (1 + rounding);
        ASSERT_GE(pixel.verdict, std::min(low, 1.0) - 0x1p-126) << "pixel " << pixel.pixel;
        ASSERT_LE(pixel.verdict, std::min(high, 1.0)) << "pixel " << pixel.pixel;
        fractions += pixel.verdict > 0.01 && pixel.verdict < 0.99 ? 1U : 0U;
    }
    EXPECT_GT(fractions, 20U);
}

TEST(ExponentialMap, IsTheFormulaInDouble)
{
    GNOMON_REQUIRE_GL();
    std::mt19937 random{7};
    for (const EsmCase& tried : {EsmCase{{"box", 1}},
                                 {{"box", 5}},
                                 {{"gaussian", 7}, 20},
                                 {{"gaussian", 9}, 300},
                                 {{"box", 5}, 80, true},
                                 {{"box", 3}, 80, false, true},
                                 {{"gaussian", 5}, 80, true, true}}) {
        SCOPED_TRACE(fmt::format("{} {}, exponent {}, reversed {}", tried.blur.kernel,
                                 tried.blur.width_texels, tried.exponent, tried.reversed));
        MethodCase c{"terrain", tried.keys()};
        const auto depths = random_depths(random, model_side_texels);
        c.give_map(depths);
        expect_formula(tried, c, tried.model(depths));
    }
}

/// Two planes face the light; the nearer covers the share q of the kernel. The map holds the mean
/// of their exponentials, so the verdict at the farther one is 1 − q + q·e^(−c·(z₂ − z₁)).
TEST(ExponentialMap, MixesTwoPlanesAsInClosedForm)
{
    GNOMON_REQUIRE_GL();
    constexpr double nearer = 0.25;
    constexpr double farther = 0.75;
    const EsmCase tried{{"box", 5}, 10};
    MethodCase c{"terrain", tried.keys()};
    scene::Image<float> depths{{model_side_texels, model_side_texels}, float{nearer}};
    for (int y = 0; y < model_side_texels; ++y) {
        for (int x = model_side_texels / 2; x < model_side_texels; ++x) {
            depths(x, y) = float{farther};
        }
    }
    c.give_map(depths);
    constexpr int middle = model_side_texels / 2;
    const auto mean_of_column = [&](int x) {
        const double share = std::clamp((middle - (x - 2)) / 5.0, 0.0, 1.0);
        return farther + std::log(1 - share + share * std::exp(-10 * (farther - nearer))) / 10;
    };
    std::size_t mixed = 0;
    for (const InnerPixel& pixel : inner_pixels(c, tried.blur.reach_texels())) {
        const double place = double{pixel.texel.x} - 0.5;
        const int x = static_cast<int>(std::floor(place));
        const double mean =
            mean_of_column(x) + (place - x) * (mean_of_column(x + 1) - mean_of_column(x));
        const double expected = std::min(1.0, std::exp(10 * (mean - pixel.receiver_depth)));
        const double off =
            10 * (tried.error_of_mean() + interpolation_error() * (farther - nearer)) + 0x1p-20;
        ASSERT_NEAR(pixel.verdict, expected, off * expected) << "pixel " << pixel.pixel;
        mixed += mean > nearer + 0.01 && mean < farther - 0.01 ? 1U : 0U;
    }
    EXPECT_GT(mixed, 100U);
}

} // namespace
} // namespace gnomon::tests
