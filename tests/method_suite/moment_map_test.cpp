// Moment shadow maps against their formula in double, in closed form, and where they fall.

#include "blur_model.hpp"
#include "random_depths.hpp"

#include <fmt/format.h>
#include <glm/matrix.hpp>
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

/// The first four moments; Hankel's matrix of them is B.
using Moments = scene::Vec4d;

glm::dmat3 hankel(const Moments& b)
{
    return {1, b.x, b.y, b.x, b.y, b.z, b.y, b.z, b.w};
}

/// The share of light at z: of all distributions with these moments the greatest that is not
/// nearer.
double light(const Moments& b, double z)
{
    const scene::Vec3d c = glm::inverse(hankel(b)) * scene::Vec3d{1, z, z * z};
    const double half_p = c.y / c.z / 2;
    const double root = std::sqrt(std::max(half_p * half_p - c.x / c.z, 0.0));
    const double nearer = -half_p - root;
    const double farther = -half_p + root;
    // The weight of each depth: of the linear functional that the moments are, Lagrange's
    // polynomial.
    const auto weight = [&](double at, double one, double other) {
        return (one * other - (one + other) * b.x + b.y) / ((at - one) * (at - other));
    };
    double shadow = 0;
    shadow += nearer < z ? weight(nearer, z, farther) : 0;
    shadow += farther < z ? weight(farther, z, nearer) : 0;
    return 1 - std::clamp(shadow, 0.0, 1.0);
}

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
            const double moment = models_[static_cast<std::size_t>(i)].at(texel);
            b[i] = moment + moment_bias * (0.5 - moment);
        }
        return b;
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

/// How little B differs from a matrix that is none of a distribution: its least eigenvalue is at
/// least its determinant over the square of half its trace.
double least_eigenvalue(const Moments& b)
{
    const double half_trace = (1 + b.y + b.w) / 2;
    return glm::determinant(hankel(b)) / (half_trace * half_trace);
}

/// Cholesky's decomposition and the roots are those of moments that are off by some roundings: the
/// sums of the blur by (w + 12)·2^-24 as in the other maps' tests, the decomposition of three rows
/// by 3·4·2^-24, the bias by 2^-23. What moments that are off by e do to the verdict is at most e
/// times 3·|B⁻¹|·|B⁻¹ (1, z, z²)|, by which the polynomial's coefficients change, in parts of them:
/// taken where that is below 1/64, and there what the formula itself does to corners of that box is
/// the measure, doubled.
void expect_moment_formula(const MsmCase& tried, MethodCase& c, const MomentModel& model)
{
    std::size_t fractions = 0;
    const double of_sums = (tried.blur.width_texels + 26) * 0x1p-24;
    for (const InnerPixel& pixel : inner_pixels(c, tried.blur.reach_texels())) {
        const Moments b = model.biased_at(pixel.texel);
        const double off = of_sums + interpolation_error() * model.spread_at(pixel.texel);
        if (3 * off > least_eigenvalue(b) / 64) {
            continue;
        }
        const double z = tried.distance(pixel.receiver_depth);
        const double expected = light(b, z);
        double apart = 0;
        for (unsigned corner = 0; corner < 32; ++corner) {
            const auto sign = [&](unsigned bit) { return (corner >> bit & 1U) != 0 ? off : -off; };
            const Moments moved = b + Moments{sign(0), sign(1), sign(2), sign(3)};
            apart = std::max(apart, std::abs(light(moved, z + sign(4)) - expected));
        }
        const double allowed = 2 * apart + 8 * 0x1p-24;
        ASSERT_NEAR(pixel.verdict, expected, allowed) << "pixel " << pixel.pixel;
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
    // Moment biases far above what rounds: where it leaves no matrix of a distribution, there is no
    // bound.
    expect_share_of_two_layers("32", 3e-5, 30 * 0x1p-24);
    // Unorm numbers round by 2^-17 in each pass, and the inverse map adds four with factors whose
    // sum is at most 1.13.
    expect_share_of_two_layers("16", 3e-3, 1.13 * 2 * 0x1p-17);
}

} // namespace
} // namespace gnomon::tests
