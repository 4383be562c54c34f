// Moment shadow maps against their formula in double and in closed form, and where verdicts fall.

#include "blur_model.hpp"
#include "hamburger_model.hpp"
#include "method_case.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

constexpr double moment_bias = 3e-5;

struct MsmCase {
    BlurChoice blur;
    bool reversed = false;

    [[nodiscard]] std::vector<scene::Override> keys() const
    {
        return with(with(model_keys("msm"), blur.keys()),
                    {{"method.moment_bias", fmt::format("{}", moment_bias)},
                     {"shadow_map.reversed", reversed ? "true" : "false"}});
    }
    [[nodiscard]] double distance(double depth) const { return reversed ? 1 - depth : depth; }
};

/// The four moments of a blurred map.
class MomentModel {
public:
    MomentModel(const scene::Image<float>& depths, const MsmCase& tried)
    {
        for (int power = 1; power <= 4; ++power) {
            models_.emplace_back(depths, tried.blur, [&tried, power](double z) {
                return std::pow(tried.distance(z), power);
            });
        }
    }
    [[nodiscard]] Moments biased_at(const scene::Vec2f& texel) const
    {
        Moments b;
        for (int i = 0; i < 4; ++i) {
            b[i] = models_[static_cast<std::size_t>(i)].at(texel);
        }
        return biased(b, moment_bias);
    }
    [[nodiscard]] double spread_at(const scene::Vec2f& texel) const
    {
        double most = 0;
        for (const BlurModel& model : models_) {
            most = std::max(most, model.spread_at(texel));
        }
        return most;
    }

private:
    std::vector<BlurModel> models_;
};

/// The sums of the blur are off by (w + 12)·2^-24 as in the other maps' tests, the decomposition of
/// three rows by 3·4·2^-24, the bias by 2^-23.
void expect_moment_formula(const MsmCase& tried, MethodCase& c, const MomentModel& model)
{
    std::size_t fractions = 0;
    const double of_sums = (tried.blur.width_texels + 26) * 0x1p-24;
    for (const InnerPixel& pixel : inner_pixels(c, tried.blur.reach_texels())) {
        const Moments b = model.biased_at(pixel.texel);
        const double off = of_sums + interpolation_error() * model.spread_at(pixel.texel);
        if (!is_well_conditioned(b, off)) {
            continue;
        }
        const LightBound light = light_bound(b, tried.distance(pixel.receiver_depth), off);
        ASSERT_GE(pixel.verdict, light.low) << "pixel " << pixel.pixel;
        ASSERT_LE(pixel.verdict, light.high) << "pixel " << pixel.pixel;
        fractions += pixel.verdict > 0.01 && pixel.verdict < 0.99 ? 1U : 0U;
    }
    EXPECT_GT(fractions, 20U);
}

TEST(MomentMap, IsTheFormulaInDouble)
{
    GNOMON_REQUIRE_GL();
    std::mt19937 random{13};
    for (const MsmCase& tried :
         {MsmCase{{"box", 5}}, {{"box", 9}}, {{"gaussian", 9}}, {{"box", 5}, true}}) {
        SCOPED_TRACE(fmt::format("{} {}, reversed {}", tried.blur.kernel, tried.blur.width_texels,
                                 tried.reversed));
        MethodCase c{"terrain", tried.keys()};
        const auto depths = random_depths(random, model_side_texels);
        c.give_map(depths);
        expect_moment_formula(tried, c, MomentModel{depths, tried});
    }
}

/// Two depths z₁ < z₂ have four moments that no other distribution has, so that at z the verdict is
/// the share that is not nearer. The moment bias α adds α/2 of depth 0 and of depth 1: the verdict
/// is no less than that share, and no more than by the mass that any distribution with these
/// moments can have at z, which is at most the mean of any square of a quadratic that is 1 at z: of
/// ((x − z₁)(x − z₂) / ((z − z₁)(z − z₂)))² it is α/2·(z₁²z₂² + (1 − z₁)²(1 − z₂)²) over the square
/// of the denominator. Rounding adds to it: moments that are off by e change a mean of a polynomial
/// by no more than e times the sum of its coefficients' sizes, ((1 + z₁)(1 + z₂) / denominator)².
void expect_share_of_two_layers(const std::string& bits, double alpha, double rounding)
{
    constexpr double nearer = 0.25;
    constexpr double farther = 0.75;
    const BlurChoice blur{"box", 5};
    MethodCase c{"terrain",
                 with(with(model_keys("msm"), blur.keys()),
                      {{"method.bits", bits}, {"method.moment_bias", fmt::format("{}", alpha)}})};
    scene::Image<float> depths{{model_side_texels, model_side_texels}, float{farther}};
    for (int y = 0; y < model_side_texels; ++y) {
        for (int x = 0; x < model_side_texels; ++x) {
            if ((x / 6 + y / 6) % 2 == 0) {
                depths(x, y) = float{nearer};
            }
        }
    }
    c.give_map(depths);
    const BlurModel share{depths, blur, [](double z) { return z < 0.5 ? 1.0 : 0.0; }};
    std::size_t between = 0;
    for (const InnerPixel& pixel : inner_pixels(c, blur.reach_texels())) {
        const double z = pixel.receiver_depth;
        const double denominator = std::abs((z - nearer) * (z - farther));
        const double q = share.at(pixel.texel);
        if (denominator < 0.03 || std::min(q, 1 - q) < 0.1) {
            continue;
        }
        const double plain = z < nearer ? 1 : z < farther ? 1 - q : 0;
        const double exact = (1 - alpha) * plain + alpha / 2;
        const double at_ends = nearer * nearer * farther * farther +
                               (1 - nearer) * (1 - nearer) * (1 - farther) * (1 - farther);
        const double size = (1 + nearer) * (1 + farther) / denominator;
        const double most = alpha / 2 * at_ends / (denominator * denominator);
        const double off = rounding * size * size + interpolation_error();
        ASSERT_GE(pixel.verdict, exact - off) << "pixel " << pixel.pixel << " at " << z;
        ASSERT_LE(pixel.verdict, exact + most + off) << "pixel " << pixel.pixel << " at " << z;
        between += z > nearer && z < farther ? 1U : 0U;
    }
    EXPECT_GT(between, 50U);
}

TEST(MomentMap, IsExactOnTwoLayers)
{
    GNOMON_REQUIRE_GL();
    // Moment biases far above the rounding errors: no bound exists for moments that no distribution
    // has.
    expect_share_of_two_layers("32", 3e-5, 30 * 0x1p-24);
    // Unorm numbers round by 2^-17 in each pass, and the inverse map adds four with factors whose
    // sum is at most 1.13.
    expect_share_of_two_layers("16", 3e-3, 1.13 * 2 * 0x1p-17);
}

} // namespace
} // namespace gnomon::tests
