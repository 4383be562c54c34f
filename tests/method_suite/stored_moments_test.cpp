// Stored moments of blurred maps, for each bit depth and level, and the verdicts of lookups in
// them.

#include "blur_model.hpp"
#include "hamburger_model.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "warp_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

constexpr double positive_exponent = 5.5;
constexpr double negative_exponent = 5;
constexpr double stored_moment_bias = 3e-4;

/// A method of moments, and its function of depth.
struct Kept {
    const char* method;
    const char* bits;
    BlurChoice blur;
    bool reversed = false;
    int samples = 1;

    [[nodiscard]] bool is_evsm() const { return std::string{method} == "evsm"; }
    [[nodiscard]] bool has_16_bits() const { return std::string{bits} == "16"; }
    [[nodiscard]] std::vector<scene::Override> keys() const
    {
        auto all = with(with(model_keys(method), blur.keys()),
                        {{"method.bits", bits},
                         {"method.samples", std::to_string(samples)},
                         {"shadow_map.reversed", reversed ? "true" : "false"}});
        if (is_evsm()) {
            return with(all, {{"method.positive_exponent", fmt::format("{}", positive_exponent)},
                              {"method.negative_exponent", fmt::format("{}", negative_exponent)},
                              {"method.min_deviation", "0"}});
        }
        return with(all, {{"method.moment_bias", fmt::format("{}", stored_moment_bias)}});
    }
    [[nodiscard]] Warp positive() const { return {positive_exponent, reversed, 0}; }
    [[nodiscard]] Warp negative() const { return {-negative_exponent, reversed, 0}; }
    [[nodiscard]] double distance(double depth) const { return reversed ? 1 - depth : depth; }

    /// The numbers of one depth.
    [[nodiscard]] std::array<double, 4> content(double depth) const
    {
        if (is_evsm()) {
            const double p = positive()(depth);
            const double n = negative()(depth);
            return {p, p * p, n, n * n};
        }
        const double z = distance(depth);
        const Moments powers{z, z * z, z * z * z, z * z * z * z};
        if (has_16_bits()) {
            return QuantisedMoments::stored(powers);
        }
        return {powers.x, powers.y, powers.z, powers.w};
    }
    /// Largest error of a stored mean.
    ///
    /// Sums err as in any blur. A warp's square errs by twice the warp's error. Each product of
    /// powers rounds; the affine map adds five such numbers and a product. With 16 bits, either
    /// pass rounds: the shader rounds half floats to nearest, by a relative 2^-11 or 2^-25,
    /// whichever is more; a driver may truncate other formats by a step of 2^-16.
    [[nodiscard]] double error(std::size_t channel, double mean) const
    {
        const double in_sums = (2 * (3 + (blur.width_texels + 1) / 2.0) + samples) * 0x1p-24;
        if (is_evsm()) {
            const Warp warp = channel < 2 ? positive() : negative();
            const double of_half = has_16_bits() ? 2 * (mean * 0x1p-11 + 0x1p-25) : 0;
            return (2 * warp.error() + 0x1p-24 + in_sums) * mean * 1.001 + of_half;
        }
        if (has_16_bits()) {
            return QuantisedMoments::sizes().at(channel) * (3 + 1 + 5) * 0x1p-24 + in_sums +
                   2 * 0x1p-16;
        }
        return (3 * 0x1p-24 + in_sums) * mean;
    }
};

std::string text(const Kept& tried)
{
    return fmt::format("{} of {} bits, {} {}, {} samples, reversed {}", tried.method, tried.bits,
                       tried.blur.kernel, tried.blur.width_texels, tried.samples, tried.reversed);
}

std::vector<scene::Image<float>> random_samples(std::mt19937& random, int samples)
{
    std::vector<scene::Image<float>> all;
    for (int i = 0; i < samples; ++i) {
        all.push_back(random_depths(random, model_side_texels));
    }
    return all;
}

/// A number of the map, averaged in double over samples and kernel; lower left first.
scene::Image<double> mean_of(const std::vector<scene::Image<float>>& samples, const Kept& tried,
                             std::size_t channel)
{
    scene::Image<double> mean{samples.front().size()};
    for (const scene::Image<float>& depths : samples) {
        const BlurModel one{depths, tried.blur,
                            [&](double z) { return tried.content(z).at(channel); }};
        for (std::size_t i = 0; i < mean.pixel_count(); ++i) {
            mean[i] += one.texels()[i] / static_cast<double>(samples.size());
        }
    }
    return mean;
}

TEST(StoredMoments, AreThoseOfTheDepthsRounded)
{
    GNOMON_REQUIRE_GL();
    std::mt19937 random{17};
    for (const Kept& tried : {Kept{"evsm", "16", {"box", 5}},
                              {"evsm", "16", {"gaussian", 9}, true},
                              {"evsm", "32", {"gaussian", 5}, false, 4},
                              {"evsm", "16", {"box", 3}, false, 4},
                              {"msm", "16", {"box", 5}},
                              {"msm", "16", {"gaussian", 9}, true},
                              {"msm", "32", {"box", 7}, true, 4},
                              {"msm", "16", {"box", 3}, false, 4}}) {
        SCOPED_TRACE(text(tried));
        if (tried.samples > shared_context()->facts().max_depth_samples) {
            continue;
        }
        MethodCase c{"terrain", tried.keys()};
        const auto samples = random_samples(random, tried.samples);
        c.give_samples(samples);
        const auto stored = c.stored();
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const auto mean = mean_of(samples, tried, channel);
            for (std::size_t i = 0; i < mean.pixel_count(); ++i) {
                ASSERT_NEAR(stored.at(channel)[i], mean[i], tried.error(channel, mean[i]))
                    << "texel " << i << ", number " << channel;
            }
        }
    }
}

/// Maps of depth 0 and depth 1 hold the values of lookups beyond the map's edge.
TEST(StoredMoments, AreOfBothEndsWhatIsReadBeyondTheEdge)
{
    GNOMON_REQUIRE_GL();
    for (const char* const method : {"evsm", "msm"}) {
        for (const char* const bits : {"16", "32"}) {
            for (const bool reversed : {false, true}) {
                const Kept tried{method, bits, {"box", 1}, reversed};
                SCOPED_TRACE(text(tried));
                MethodCase c{"terrain", tried.keys()};
                const auto ends = methods::passes(c.job).of_ends;
                for (std::size_t end = 0; end < 2; ++end) {
                    const auto depth = static_cast<float>(end);
                    c.give_map(scene::Image<float>{{model_side_texels, model_side_texels}, depth});
                    const auto stored = c.stored();
                    for (std::size_t channel = 0; channel < 4; ++channel) {
                        const double expected = double{ends.at(end).at(channel)};
                        EXPECT_NEAR(stored.at(channel)[0], expected, tried.error(channel, expected))
                            << "depth " << end << ", number " << channel;
                    }
                }
            }
        }
    }
}

/// The four numbers of a map that was read back, interpolated at a lookup.
using Numbers = std::array<BlurredNumber, 4>;

/// Bounds on the verdict for these numbers; empty if the moments are so extreme that rounding
/// decides.
struct Verdicts {
    bool is_known = true;
    double low = 0;
    double high = 0;
};
Verdicts verdicts_of(const Kept& tried, const Numbers& numbers, double receiver_depth)
{
    if (tried.is_evsm()) {
        const auto errors = MomentErrors::of_interpolation();
        const WarpBound p =
            warp_bound(tried.positive(), numbers[0], numbers[1], errors, receiver_depth);
        const WarpBound n =
            warp_bound(tried.negative(), numbers[2], numbers[3], errors, receiver_depth);
        const double rounding = 6 * 0x1p-24;
        return {true, std::min(p.low, n.low) - rounding, std::min(p.high, n.high) + rounding};
    }
    std::array<double, 4> stored{};
    double spread = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        stored.at(i) = numbers.at(i).value;
        spread = std::max(spread, numbers.at(i).spread);
    }
    const Moments moments = tried.has_16_bits()
                                ? QuantisedMoments::moments(stored)
                                : Moments{stored[0], stored[1], stored[2], stored[3]};
    // The interpolation 4, the affine map back nine of sums below 1.5, its coefficients' ten digits
    // less; the decomposition 12, the bias 2.
    const double off = (4 + 14 + 12 + 2) * 0x1p-24 + 1.5 * interpolation_error() * spread;
    const Moments b = biased(moments, stored_moment_bias);
    if (!is_well_conditioned(b, off)) {
        return {.is_known = false};
    }
    const LightBound light = light_bound(b, tried.distance(receiver_depth), off);
    return {true, light.low, light.high};
}

std::array<BlurModel, 4> models_of(const std::array<scene::Image<double>, 4>& stored)
{
    return {BlurModel{stored[0]}, BlurModel{stored[1]}, BlurModel{stored[2]}, BlurModel{stored[3]}};
}

Numbers numbers_at(const std::array<BlurModel, 4>& models, const scene::Vec2d& texel)
{
    return {models[0].number_at(texel), models[1].number_at(texel), models[2].number_at(texel),
            models[3].number_at(texel)};
}

TEST(StoredMoments, AreLookedUpByTheFormulaInDouble)
{
    GNOMON_REQUIRE_GL();
    std::mt19937 random{19};
    for (const Kept& tried : {Kept{"evsm", "16", {"box", 5}},
                              {"evsm", "16", {"gaussian", 9}, true},
                              {"evsm", "32", {"box", 9}},
                              {"msm", "16", {"box", 5}},
                              {"msm", "16", {"gaussian", 9}, true},
                              {"msm", "32", {"box", 9}}}) {
        SCOPED_TRACE(text(tried));
        MethodCase c{"terrain", tried.keys()};
        c.give_map(random_depths(random, model_side_texels));
        const auto models = models_of(c.stored());
        std::size_t fractions = 0;
        for (const InnerPixel& pixel : inner_pixels(c, 1)) {
            const Verdicts expected =
                verdicts_of(tried, numbers_at(models, pixel.texel), pixel.receiver_depth);
            if (!expected.is_known) {
                continue;
            }
            ASSERT_GE(pixel.verdict, expected.low) << "pixel " << pixel.pixel;
            ASSERT_LE(pixel.verdict, expected.high) << "pixel " << pixel.pixel;
            const bool is_tight = expected.high - expected.low < 0.01;
            fractions += is_tight && pixel.verdict > 0.01 && pixel.verdict < 0.99 ? 1U : 0U;
        }
        EXPECT_GT(fractions, 20U);
    }
}

/// By how many texels of level 0 a lookup moves to the next pixel, as uv's change is defined: to
/// the next pixel of a row or column, or from the one before, where it shows the same triangle;
/// else 0.
class Gradients {
public:
    explicit Gradients(MethodCase& c) : lookup_{c.look_up()}, triangles_{c.triangles()} {}

    struct Levels {
        double lowest = 0;
        double highest = 0;
    };
    /// The levels that GL may blend. With m_u the greater change of u, of v likewise, ρ lies
    /// between the greater of both and their sum (OpenGL 4.5, 8.14.1), and λ is its logarithm,
    /// which drivers take from a line between powers of two: log₂(1 + x) − x is at most 0.0861.
    [[nodiscard]] Levels levels_at(std::size_t pixel) const
    {
        const int width = triangles_.size().width_px;
        const int x = static_cast<int>(pixel) % width;
        const int y = static_cast<int>(pixel) / width;
        const scene::Vec2d along_row = change(x, y, 1, 0);
        const scene::Vec2d along_column = change(x, y, 0, -1);
        const double m_u = std::max(std::abs(along_row.x), std::abs(along_column.x));
        const double m_v = std::max(std::abs(along_row.y), std::abs(along_column.y));
        return {std::log2(std::max(m_u, m_v)) - 0.09, std::log2(m_u + m_v) + 0.09};
    }

private:
    [[nodiscard]] bool shows(int x, int y, std::uint32_t triangle) const
    {
        const auto [width, height] = triangles_.size();
        return x >= 0 && y >= 0 && x < width && y < height && triangles_(x, y) == triangle;
    }
    [[nodiscard]] scene::Vec2d texel(int x, int y) const
    {
        return scene::Vec2d{lookup_.texels(x, y)};
    }
    [[nodiscard]] scene::Vec2d change(int x, int y, int dx, int dy) const
    {
        const std::uint32_t triangle = triangles_(x, y);
        if (shows(x + dx, y + dy, triangle)) {
            return texel(x + dx, y + dy) - texel(x, y);
        }
        return shows(x - dx, y - dy, triangle) ? texel(x, y) - texel(x - dx, y - dy)
                                               : scene::Vec2d{0};
    }

    scene::LookupLayers lookup_;
    scene::Image<std::uint32_t> triangles_;
};

/// All levels of a map that was read back.
class LevelModels {
public:
    explicit LevelModels(const MethodCase& c)
    {
        for (int side = c.job.shadow_map.resolution_texels; side > 0; side /= 2) {
            levels_.push_back(models_of(c.stored(static_cast<int>(levels_.size()))));
        }
    }
    [[nodiscard]] Numbers at(const scene::Vec2d& texel, double level) const
    {
        const double last = static_cast<double>(levels_.size()) - 1;
        const double within = std::clamp(level, 0.0, last);
        const double below = std::min(std::floor(within), last - 1);
        const auto finer = static_cast<std::size_t>(below);
        const Numbers a = numbers_at(levels_[finer], std::exp2(-below) * texel);
        const Numbers b = numbers_at(levels_[finer + 1], std::exp2(-below - 1) * texel);
        Numbers mixed;
        for (std::size_t i = 0; i < 4; ++i) {
            mixed.at(i).value = std::lerp(a.at(i).value, b.at(i).value, within - below);
            mixed.at(i).spread = std::max(a.at(i).spread, b.at(i).spread);
        }
        return mixed;
    }

private:
    std::vector<std::array<BlurModel, 4>> levels_;
};

/// Verdicts for all levels between two, in steps. Assumes that between steps a verdict changes no
/// more than from one step to the next.
Verdicts verdicts_between(const Kept& tried, const LevelModels& models, const InnerPixel& pixel,
                          const Gradients::Levels& levels)
{
    constexpr int steps = 32;
    Verdicts hull{.low = 1, .high = 0};
    double jump = 0;
    double last = 0;
    for (int i = 0; i <= steps; ++i) {
        const double level =
            std::lerp(levels.lowest, levels.highest, static_cast<double>(i) / steps);
        const Verdicts here =
            verdicts_of(tried, models.at(scene::Vec2d{pixel.texel}, level), pixel.receiver_depth);
        if (!here.is_known) {
            return here;
        }
        jump = i > 0 ? std::max(jump, std::abs(here.low - last)) : 0;
        last = here.low;
        hull.low = std::min(hull.low, here.low);
        hull.high = std::max(hull.high, here.high);
    }
    return {true, hull.low - jump, hull.high + jump};
}

TEST(StoredMoments, AreMixedOfLevelsAsUvChanges)
{
    GNOMON_REQUIRE_GL();
    constexpr int side = 512;
    std::mt19937 random{23};
    for (const Kept& tried : {Kept{"evsm", "32", {"box", 9}},
                              {"msm", "16", {"box", 9}},
                              {"msm", "32", {"box", 9}, true}}) {
        SCOPED_TRACE(text(tried));
        MethodCase c{"sphere-plane",
                     with(tried.keys(), {{"method.mips", "true"},
                                         {"shadow_map.resolution", std::to_string(side)}})};
        c.give_map(random_depths(random, side));
        const LevelModels models{c};
        const Gradients gradients{c};
        std::size_t tight = 0;
        for (const InnerPixel& pixel : inner_pixels(c, 1)) {
            const auto levels = gradients.levels_at(pixel.pixel);
            if (!(levels.highest > 0)) {
                continue;
            }
            const Verdicts expected = verdicts_between(tried, models, pixel, levels);
            if (!expected.is_known) {
                continue;
            }
            ASSERT_GE(pixel.verdict, expected.low) << "pixel " << pixel.pixel;
            ASSERT_LE(pixel.verdict, expected.high) << "pixel " << pixel.pixel;
            tight += levels.lowest > 0.5 && expected.high - expected.low < 0.25 ? 1U : 0U;
        }
        EXPECT_GT(tight, 20U);
    }
}

} // namespace
} // namespace gnomon::tests
