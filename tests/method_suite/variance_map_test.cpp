// Variance shadow maps against closed forms.

#include "analysis/bias/bias_verification.hpp"
#include "analysis/lookup/bias_order.hpp"
#include "compared.hpp"
#include "lane.hpp"
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

using analysis::Label;

const std::vector<scene::Override> vsm{
    {"method.name", "vsm"},      {"shadow_map.depth_format", "d32f"},
    {"lookup.outside", "clamp"}, {"bias.constant", "0"},
    {"bias.slope", "0"},         {"bias.normal_texels", "0"}};

/// A plane's depths in texel (x, y) of a map of 64 × 64: exact in float32.
struct PlaneOfDepths {
    static constexpr int side = 64;
    static constexpr double first = 0.125;
    static constexpr double per_x = 0x1p-7;
    static constexpr double per_y = 0x1p-8;

    static scene::Image<float> image()
    {
        scene::Image<float> depths{{side, side}};
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                depths(x, side - 1 - y) = static_cast<float>(first + per_x * x + per_y * y);
            }
        }
        return depths;
    }
};

struct KernelCase {
    const char* kernel;
    int width;
    double bleeding_reduction;

    /// The variance of the kernel's texel positions: (w² − 1)/12 for a box; (w − 1)/4 for binomial
    /// weights, the sum of w − 1 coin tosses.
    [[nodiscard]] double variance() const
    {
        return std::string{kernel} == "box" ? (width * width - 1) / 12.0 : (width - 1) / 4.0;
    }
};

/// Bounds on Chebyshev's bound for a plane's moments, given GL's rounding.
///
/// With weights 1 − f and f two neighbouring kernels' moments are interpolated: their mean is that
/// of the plane at the point looked up, and since both have the variance g²·V along an axis and
/// means g apart,
///
///     σ² = Σ over both axes of g²·(V + f(1 − f))
///
/// Rounding: of each moment, relative to it, in units of 2^-24: z² 1; in either pass the weight 1,
/// the sum of two texels 1, the product 1, and (w + 1)/2 sums; the interpolation 4. The variance is
/// M₂ − M₁², so that it is off by e·M₂ + 2e·M₁² ≤ 3e·M₂, and two roundings of at most M₂.
class BoundOfPlane {
public:
    BoundOfPlane(const KernelCase& kernel, double min_variance)
        : kernel_{kernel},
          min_variance_{min_variance},
          relative_error_{(1 + 2 * (3 + (kernel.width + 1) / 2.0) + 4) * 0x1p-24},
          // The error of f: the product uv · 64 and a difference round; other drivers keep 8 bits.
          weight_error_{shader_arithmetic_is_ieee() ? 64 * 0x1p-23 : 0x1p-8}
    {
    }

    struct Interval {
        double low = 0;
        double high = 0;
    };
    [[nodiscard]] Interval verdict(float r, const scene::Vec2f& texel) const
    {
        using Plane = PlaneOfDepths;
        const double x = double{texel.x} - 0.5;
        const double y = double{texel.y} - 0.5;
        const double mean = Plane::first + Plane::per_x * x + Plane::per_y * y;
        const double variance = along(x, Plane::per_x) + along(y, Plane::per_y);
        const double second = mean * mean + variance;
        const double slope = Plane::per_x + Plane::per_y;
        const double off =
            (3 * relative_error_ + 2 * 0x1p-24) * second + slope * slope * weight_error_;
        const double beyond = double{r} - mean;
        const double beyond_off = relative_error_ * mean + slope * weight_error_ + 0x1p-24;
        return {of(variance - off, beyond + beyond_off), of(variance + off, beyond - beyond_off)};
    }

private:
    [[nodiscard]] double along(double place, double slope) const
    {
        const double f = place - std::floor(place);
        return slope * slope * (kernel_.variance() + f * (1 - f));
    }
    [[nodiscard]] double of(double variance, double beyond) const
    {
        const double at_least = std::max(variance, min_variance_);
        const double bound = beyond <= 0 ? 1 : at_least / (at_least + beyond * beyond);
        const double reduction = kernel_.bleeding_reduction;
        return std::clamp((bound - reduction) / (1 - reduction), 0.0, 1.0);
    }

    KernelCase kernel_;
    double min_variance_;
    double relative_error_;
    double weight_error_;
};

TEST(VarianceMap, BoundsTheLightOfATiltedPlaneAsInClosedForm)
{
    GNOMON_REQUIRE_GL();
    using Plane = PlaneOfDepths;
    for (const char* const builtin : {"sphere-plane", "terrain"}) {
        const auto base = with(vsm, {{"image.width", "320"},
                                     {"image.height", "180"},
                                     {"shadow_map.resolution", std::to_string(Plane::side)}});
        MethodCase c{builtin, base};
        const auto triangles = c.triangles();
        for (const KernelCase& kernel : {KernelCase{"box", 1, 0},
                                         {"box", 3, 0},
                                         {"box", 5, 0.25},
                                         {"box", 9, 0},
                                         {"gaussian", 3, 0},
                                         {"gaussian", 7, 0.1},
                                         {"gaussian", 9, 0}}) {
            SCOPED_TRACE(fmt::format("{} {} {} reduction {}", builtin, kernel.kernel, kernel.width,
                                     kernel.bleeding_reduction));
            c.set(job_of_builtin(builtin,
                                 with(base, {{"method.kernel", kernel.kernel},
                                             {"method.kernel_width", std::to_string(kernel.width)},
                                             {"method.min_variance", "1e-6"},
                                             {"method.bleeding_reduction",
                                              fmt::format("{}", kernel.bleeding_reduction)}})));
            c.give_map(Plane::image());
            const auto lookup = c.look_up();
            const BoundOfPlane bound{kernel, 1e-6};
            const int reach_texels = kernel.width / 2 + 1;
            const auto reach = static_cast<float>(reach_texels);
            std::size_t fractions = 0;
            for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
                const scene::Vec2f texel = lookup.texels[i];
                const bool is_inside =
                    std::min(texel.x, texel.y) > reach &&
                    std::max(texel.x, texel.y) < static_cast<float>(Plane::side) - reach;
                if (triangles[i] == scene::no_triangle || !is_inside) {
                    continue;
                }
                const auto& sample = lookup.samples[i];
                const auto expected = bound.verdict(sample.receiver_depth, texel);
                // The last quotient, difference and product round.
                const double rounding = 3 * 0x1p-24;
                ASSERT_GE(sample.verdict, expected.low - rounding)
                    << "pixel " << i << ", r " << sample.receiver_depth << " at " << texel.x << ", "
                    << texel.y;
                ASSERT_LE(sample.verdict, expected.high + rounding)
                    << "pixel " << i << ", r " << sample.receiver_depth << " at " << texel.x << ", "
                    << texel.y;
                fractions += sample.verdict > 0.01F && sample.verdict < 0.99F ? 1U : 0U;
            }
            EXPECT_GT(fractions, 100U);
        }
    }
}

/// The ground under a plate that hides all of it, under a second plate that hides part of the
/// first. Everything is blocked, but depths 0.75 apart have a variance that lets light through to
/// 0.125 below.
scene::SceneFile stacked_plates()
{
    return plates_over_ground({{-4, 4, -4, 4, 1}, {-2, 1, -1, 2, 7}});
}

analysis::Comparison bleeding(const Compared& scene, double reduction)
{
    return scene(looking_down(job_of_builtin(
        "wall", with(vsm, {{"method.bleeding_reduction", fmt::format("{}", reduction)}}))));
}

TEST(VarianceMap, BleedsBetweenStackedPlates)
{
    GNOMON_REQUIRE_GL();
    const Compared scene{stacked_plates()};
    const auto result = bleeding(scene, 0);
    const auto& causes = result.diagnosis->causes;
    ASSERT_EQ(result.metrics.pixels.of(scene::PixelClass::blocked), 128U * 128U);
    EXPECT_GT(result.metrics.false_lit, 200U);
    EXPECT_GT(result.metrics.amounts.partial, 200U);
    EXPECT_EQ(causes.counts.of(Label::bleed), result.metrics.false_lit);
    EXPECT_EQ(causes.counts.of(analysis::Cause::filter), result.metrics.false_lit);
    // Amounts are rounded to 2^-32 of a pixel.
    EXPECT_NEAR(causes.amounts.of(Label::bleed) + result.metrics.amounts.unassigned,
                result.metrics.amounts.light, 0x1p-31 * 128 * 128);
    // Far from the upper plate's border nothing bleeds: if all depths of a kernel are equal, the
    // verdict is at most 1e-6 / (1e-6 + 0.125²).
    EXPECT_LT(result.lookup.samples(4, 4).verdict, 1e-4F);
}

TEST(VarianceMap, BleedsTheLessTheMoreItIsReduced)
{
    GNOMON_REQUIRE_GL();
    const Compared scene{stacked_plates()};
    double before = bleeding(scene, 0).diagnosis->causes.amounts.of(Label::bleed);
    for (const double reduction : in_lane<std::vector<double>>({0.2, 0.6}, {0.05, 0.2, 0.4, 0.6})) {
        const double now = bleeding(scene, reduction).diagnosis->causes.amounts.of(Label::bleed);
        EXPECT_LT(now, before) << "reduction " << reduction;
        before = now;
    }
    // Chebyshev's bound there is at most 0.57: the largest over the share s of the upper plate,
    // s(1 − s)·0.75² over itself and (0.125 + 0.75·s)².
    EXPECT_EQ(before, 0);
}

TEST(VarianceMap, NeverFallsWithTheBias)
{
    GNOMON_REQUIRE_GL();
    std::mt19937 random{20250401};
    std::uint64_t tries = 0;
    std::uint64_t monotonicity = 0;
    for (const char* const reversed : {"false", "true"}) {
        for (const char* const content : {"rg32f", "rg16", "rg16f"}) {
            for (const char* const variance : {"0", "1e-6"}) {
                const auto keys = with(vsm, {{"image.width", "320"},
                                             {"image.height", "180"},
                                             {"shadow_map.resolution", "256"},
                                             {"shadow_map.reversed", reversed},
                                             {"method.content", content},
                                             {"method.min_variance", variance},
                                             {"method.bleeding_reduction", "0.15"},
                                             {"method.kernel_width", "3"}});
                MethodCase c{"terrain", keys};
                const auto triangles = c.triangles();
                c.give_map(random_depths(random, 256));
                std::uniform_real_distribution<double> share{-1, 1};
                for (int pair = 0; pair < 4; ++pair) {
                    const float bias = static_cast<float>(
                        std::copysign(std::exp2(-12 * share(random) - 13), share(random)));
                    // Steps by one float of the bias, by one of a receiver's depth, and by a random
                    // amount.
                    const float next = pair == 0   ? analysis::next_bias(bias)
                                       : pair == 1 ? bias + 0x1p-24F
                                       : pair == 2 ? bias + 0x1p-22F
                                                   : bias + std::abs(bias);
                    const auto lower = c.look_up(bias);
                    const auto upper = c.look_up(next);
                    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
                        if (triangles[i] == scene::no_triangle) {
                            continue;
                        }
                        ++tries;
                        const float before = lower.samples[i].verdict;
                        const float after = upper.samples[i].verdict;
                        monotonicity += after > before ? 1U : 0U;
                        ASSERT_GE(after, before)
                            << content << " reversed " << reversed << " least variance " << variance
                            << ", biases " << bias << " and " << next << ", pixel " << i << ", r "
                            << lower.samples[i].receiver_depth;
                    }
                }
            }
        }
    }
    EXPECT_GE(tries, 1'000'000U);
    EXPECT_GT(monotonicity, 10'000U);
}

/// Half in a geometric sequence, half at, just below and just above critical biases.
std::vector<float> biases_to_try(const scene::Image<float>& criticals, std::size_t count)
{
    std::vector<float> finite;
    std::ranges::copy_if(criticals, std::back_inserter(finite),
                         [](float critical) { return std::isfinite(critical) && critical != 0; });
    std::vector<float> biases;
    const std::size_t half = count / 2;
    for (std::size_t i = 0; i < half; ++i) {
        const double share = static_cast<double>(i + 1) / static_cast<double>(half);
        biases.push_back(static_cast<float>(std::pow(1e-7, 1 - share)));
    }
    std::mt19937 random{3};
    while (biases.size() < count && !finite.empty()) {
        const float critical = finite[random() % finite.size()];
        biases.push_back(biases.size() % 3 == 0   ? critical
                         : biases.size() % 3 == 1 ? analysis::previous_bias(critical)
                                                  : analysis::next_bias(critical));
    }
    std::ranges::sort(biases);
    biases.erase(std::unique(biases.begin(), biases.end()), biases.end());
    return biases;
}

TEST(VarianceMap, HasTheCurveThatManyRerunsHave)
{
    GNOMON_REQUIRE_GL();
    const std::vector<std::string> scenes{"sphere-plane", "yard", "terrain", "columns"};
    const std::size_t scene_count = in_lane<std::size_t>(2, scenes.size());
    for (std::size_t s = 0; s < scene_count; ++s) {
        MethodCase c{scenes[s],
                     with(vsm, {{"image.width", "320"},
                                {"image.height", "180"},
                                {"shadow_map.resolution", "256"},
                                {"bias.slope", s % 2 == 0 ? "0" : "0.002"},
                                {"shadow_map.reversed", s % 2 == 0 ? "false" : "true"}})};
        c.draw_map();
        const auto triangles = c.triangles();
        const auto criticals = c.find_critical_biases();
        for (const float bias : biases_to_try(criticals, in_lane(20U, 200U))) {
            const auto rerun =
                analysis::compare_with_curve(c.look_up(bias), triangles, criticals, bias);
            EXPECT_EQ(rerun.differences, 0U) << scenes[s] << " bias " << bias;
        }
    }
}

} // namespace
} // namespace gnomon::tests
