// Exponential variance shadow maps against their formula in double, and in closed form.

#include "blur_model.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "warp_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

constexpr double least_deviation = 1e-3; // of depths

struct EvsmCase {
    BlurChoice blur;
    int moments = 4;
    double positive = 40;
    double negative = 5;
    bool reversed = false;

    [[nodiscard]] std::vector<scene::Override> keys() const
    {
        return with(with(model_keys("evsm"), blur.keys()),
                    {{"method.moments", std::to_string(moments)},
                     {"method.positive_exponent", fmt::format("{}", positive)},
                     {"method.negative_exponent", fmt::format("{}", negative)},
                     {"method.min_deviation", fmt::format("{}", least_deviation)},
                     {"shadow_map.reversed", reversed ? "true" : "false"}});
    }
    [[nodiscard]] Warp warp(double exponent) const { return {exponent, reversed, least_deviation}; }
};

/// Both moments of a warp of depths, blurred.
class BlurredWarp {
public:
    BlurredWarp(const scene::Image<float>& depths, const BlurChoice& blur, const Warp& warp)
        : warp_{warp},
          errors_{MomentErrors::of_blur(warp, blur.width_texels)},
          first_{depths, blur, warp},
          second_{depths, blur, [&warp](double z) { return warp(z) * warp(z); }}
    {
    }
    [[nodiscard]] WarpBound bound(const InnerPixel& pixel) const
    {
        return warp_bound(warp_, first_.number_at(pixel.texel), second_.number_at(pixel.texel),
                          errors_, pixel.receiver_depth);
    }

private:
    Warp warp_;
    MomentErrors errors_;
    BlurModel first_;
    BlurModel second_;
};

TEST(ExponentialVarianceMap, IsTheFormulaInDouble)
{
    GNOMON_REQUIRE_GL();
    std::mt19937 random{11};
    for (const EvsmCase& tried : {EvsmCase{{"box", 1}},
                                  {{"box", 5}},
                                  {{"gaussian", 7}, 2, 20},
                                  {{"gaussian", 9}, 4, 10, 10},
                                  {{"box", 9}, 2, 43.32},
                                  {{"box", 3}, 4, 40, 5, true},
                                  {{"gaussian", 5}, 4, 5.5, 5.5, true}}) {
        SCOPED_TRACE(fmt::format("{} {}, {} moments, exponents {} and {}, reversed {}",
                                 tried.blur.kernel, tried.blur.width_texels, tried.moments,
                                 tried.positive, tried.negative, tried.reversed));
        MethodCase c{"terrain", tried.keys()};
        const auto depths = random_depths(random, model_side_texels);
        c.give_map(depths);
        const BlurredWarp positive{depths, tried.blur, tried.warp(tried.positive)};
        const BlurredWarp negative{depths, tried.blur, tried.warp(-tried.negative)};
        std::size_t fractions = 0;
        for (const InnerPixel& pixel : inner_pixels(c, tried.blur.reach_texels())) {
            auto expected = positive.bound(pixel);
            if (tried.moments == 4) {
                const auto other = negative.bound(pixel);
                expected = {std::min(expected.low, other.low), std::min(expected.high, other.high)};
            }
            // The last sums and quotients round.
            const double rounding = 6 * 0x1p-24;
            ASSERT_GE(pixel.verdict, expected.low - rounding) << "pixel " << pixel.pixel;
            ASSERT_LE(pixel.verdict, expected.high + rounding) << "pixel " << pixel.pixel;
            fractions += pixel.verdict > 0.01 && pixel.verdict < 0.99 ? 1U : 0U;
        }
        EXPECT_GT(fractions, 20U);
    }
}

/// Two planes face the light; the nearer covers the share q of the footprint. The farther one is
/// lit to 1 − q: Chebyshev's bound is exact for two depths and any warp.
TEST(ExponentialVarianceMap, LightsTheFartherOfTwoPlanesByItsShare)
{
    GNOMON_REQUIRE_GL();
    for (const int moments : {2, 4}) {
        EvsmCase tried{{"box", 5}, moments, 10, 5};
        MethodCase c{"terrain", with(tried.keys(), {{"method.min_deviation", "0"}})};
        // The receiver is on the farther plane, so each map serves one receiver.
        std::size_t tries = 0;
        const auto pixels = [&] {
            c.give_map(scene::Image<float>{{model_side_texels, model_side_texels}, 1.0F});
            return inner_pixels(c, tried.blur.reach_texels());
        }();
        for (std::size_t i = 0; i < pixels.size(); i += pixels.size() / 8 + 1) {
            const auto farther = static_cast<float>(pixels[i].receiver_depth);
            const float nearer = farther * 0.5F;
            const int edge = static_cast<int>(pixels[i].texel.x);
            scene::Image<float> depths{{model_side_texels, model_side_texels}, farther};
            for (int y = 0; y < model_side_texels; ++y) {
                for (int x = 0; x < edge; ++x) {
                    depths(x, y) = nearer;
                }
            }
            c.give_map(depths);
            const BlurModel share{depths, tried.blur,
                                  [&](double z) { return z < double{farther} ? 1.0 : 0.0; }};
            const auto& sample = c.look_up().samples[pixels[i].pixel];
            // As in the formula above, with σ² at least 0.05 of the moments: 1e-5 is 100 times the
            // rounding errors.
            EXPECT_NEAR(sample.verdict, 1 - share.at(pixels[i].texel),
                        1e-4 + interpolation_error());
            ++tries;
        }
        EXPECT_GE(tries, 4U);
    }
}

TEST(ExponentialVarianceMap, RefusesExponentsWhoseSquaresOverflow)
{
    const auto refusal = [](const std::vector<scene::Override>& keys) -> std::string {
        try {
            methods::check(job_of_builtin("wall", with({{"method.name", "evsm"}}, keys)));
        } catch (const scene::InputError& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_EQ(refusal({{"method.positive_exponent", "43.32"}}), "no error");
    EXPECT_NE(refusal({{"method.positive_exponent", "43.4"}})
                  .find("method.positive_exponent = 43.4: the square of e^43.4 overflows sums of "
                        "32-bit floats; use 43.32 or less"),
              std::string::npos);
    EXPECT_EQ(refusal({{"method.bits", "16"}}), "no error");
    EXPECT_NE(refusal({{"method.bits", "16"}, {"method.positive_exponent", "6"}})
                  .find("use 5.54 or less, or method.bits = 32"),
              std::string::npos);
    EXPECT_NE(refusal({{"method.bits", "16"}, {"method.negative_exponent", "6"}})
                  .find("method.negative_exponent = 6"),
              std::string::npos);
    // With two moments there is no negative warp.
    EXPECT_EQ(
        refusal(
            {{"method.bits", "16"}, {"method.moments", "2"}, {"method.negative_exponent", "6"}}),
        "no error");
}

} // namespace
} // namespace gnomon::tests
