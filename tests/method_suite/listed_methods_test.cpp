// Properties of every method in the list, with each of its filters and other values of its own
// keys.

#include "analysis/bias/bias_verification.hpp"
#include "analysis/lookup/amounts.hpp"
#include "compared.hpp"
#include "lane.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Label;
using methods::LookupTraits;
using methods::Monotone;
using methods::Verdict;

const std::vector<scene::Override> small{{"image.width", "160"},
                                         {"image.height", "90"},
                                         {"shadow_map.resolution", "128"},
                                         {"shadow_map.depth_format", "d32f"},
                                         {"lookup.outside", "clamp"}};

class ListedMethod : public testing::TestWithParam<Configuration> {
protected:
    void SetUp() override
    {
        const int samples = methods::passes(job_of_builtin("wall", keys())).samples;
        if (shared_context() != nullptr && samples > shared_context()->facts().max_depth_samples) {
            GTEST_SKIP() << "no depth textures of " << samples << " samples";
        }
    }
    [[nodiscard]] static std::vector<scene::Override>
    keys(const std::vector<scene::Override>& more = {})
    {
        return with(with(small, GetParam().keys), more);
    }
};

/// Methods that compare depths of a map.
class MethodOfDepths : public ListedMethod {};

/// Methods whose verdicts rotate with the plates. Excluded are methods that depend on triangles (a
/// plate's diagonal does not rotate), asymmetric kernels, and non-monotone verdicts, where rounding
/// decides with another order of sums.
class MethodThatTurns : public ListedMethod {};

/// Methods with monotone verdicts.
class MethodThatRises : public ListedMethod {};

/// Methods with an exact bias curve.
class MethodOfExactCurve : public ListedMethod {};

/// Verdicts are 0 or 1 if the method's traits say so.
void expect_promised_verdicts(const scene::LookupLayers& lookup, const LookupTraits& promised)
{
    for (std::size_t i = 0; i < lookup.samples.pixel_count(); ++i) {
        const float verdict = lookup.samples[i].verdict;
        ASSERT_TRUE(verdict >= 0 && verdict <= 1) << "pixel " << i << ": " << verdict;
        if (promised.verdict == Verdict::binary) {
            ASSERT_TRUE(verdict == 0 || verdict == 1) << "pixel " << i << ": " << verdict;
        }
    }
}

/// Checks verdicts of receivers in the middle of the range under a map of constant depth.
void expect_verdict_of_constant(MethodCase& c, float depth, bool is_lit)
{
    SCOPED_TRACE(fmt::format("depth {} everywhere", depth));
    const int side = c.job.shadow_map.resolution_texels;
    c.give_map(scene::Image<float>{{side, side}, depth});
    const auto lookup = c.look_up();
    const auto triangles = c.triangles();
    const LookupTraits promised = methods::traits(c.job);
    expect_promised_verdicts(lookup, promised);
    // Receivers are at least 0.18 from the map's depth, farther than any format's step. Half floats
    // hold that depth and its square exactly. Fractions may err by 1/256, the usual tolerance.
    // 16-bit unorm formats round a moment by 2^-17 in each of two passes, so a variance of 0
    // becomes 2 · 3 · 2^-17, and Chebyshev's bound 0.0013. Non-monotone verdicts, where rounding
    // decides, get twice the tolerance.
    const double allowed = promised.verdict == Verdict::binary         ? 0
                           : promised.monotonicity.how == Monotone::no ? 2 * analysis::partial_above
                                                                       : analysis::partial_above;
    std::size_t count = 0;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        const auto& sample = lookup.samples[i];
        if (triangles[i] == scene::no_triangle || sample.receiver_depth < 0.25F ||
            sample.receiver_depth > 0.75F) {
            continue;
        }
        ++count;
        ASSERT_LE(std::abs(double{sample.verdict} - (is_lit ? 1 : 0)), allowed)
            << "pixel " << i << ", receiver depth " << sample.receiver_depth;
    }
    EXPECT_GT(count, 500U);
}

TEST_P(MethodOfDepths, GivesTheObviousVerdictsOfAMapOfConstantDepth)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin : {"sphere-plane", "terrain"}) {
        for (const bool reversed : {false, true}) {
            SCOPED_TRACE(fmt::format("{} reversed {}", builtin, reversed));
            MethodCase c{builtin, keys({{"shadow_map.reversed", reversed ? "true" : "false"},
                                        {"bias.constant", "0"},
                                        {"bias.slope", "0"},
                                        {"bias.normal_texels", "0"}})};
            expect_verdict_of_constant(c, 0.9375F, !reversed);
            expect_verdict_of_constant(c, 0.0625F, reversed);
        }
    }
}

/// Ascending, of both signs, from far above a float32 step at depth 1 down to below it.
std::vector<float> ascending_biases()
{
    std::vector<float> biases{0};
    for (int exponent = -30; exponent <= 0; exponent += in_lane(3, 2)) {
        for (const float factor : {1.0F, 1.37F}) {
            biases.push_back(std::ldexp(factor, exponent));
            biases.push_back(-std::ldexp(factor, exponent));
        }
    }
    std::ranges::sort(biases);
    return biases;
}

TEST_P(ListedMethod, PromisesTheSamplesThatItsPassesAskFor)
{
    const scene::Job job = job_of_builtin("wall", keys());
    EXPECT_EQ(methods::traits(job).samples, methods::passes(job).samples);
    EXPECT_EQ(methods::traits(job).layers, methods::passes(job).layers);
}

TEST_P(MethodThatRises, RisesWithTheBiasAsPromised)
{
    GNOMON_REQUIRE_GL();
    for (const char* const reversed : {"false", "true"}) {
        MethodCase c{"sphere-plane", keys({{"shadow_map.reversed", reversed}})};
        const LookupTraits promised = methods::traits(c.job);
        c.draw_map();
        std::vector<float> before;
        std::size_t monotonicity = 0;
        const std::vector<float> biases = ascending_biases();
        // The usual lane tries only some biases if the method ignores them.
        const std::size_t step = runs_full_tests() || promised.has_curve() ? 1 : 8;
        for (std::size_t at = 0; at < biases.size(); at += step) {
            const float bias = biases[at];
            const auto lookup = c.look_up(bias);
            expect_promised_verdicts(lookup, promised);
            for (std::size_t i = 0; i < before.size(); ++i) {
                const float now = lookup.samples[i].verdict;
                monotonicity += now > before[i] ? 1U : 0U;
                ASSERT_LE(double{before[i]} - double{now}, promised.monotonicity.largest_fall)
                    << "reversed " << reversed << ", pixel " << i << ": from " << before[i]
                    << " to " << now << " at bias " << bias;
            }
            before.clear();
            for (const auto& sample : lookup.samples) {
                before.push_back(sample.verdict);
            }
        }
        if (promised.has_curve()) {
            EXPECT_GT(monotonicity, 5000U);
        } else {
            EXPECT_EQ(monotonicity, 0U) << "no bias was said to matter";
        }
    }
}

TEST_P(ListedMethod, GivesTheSameBytesTwice)
{
    GNOMON_REQUIRE_GL();
    const std::string builtin = in_lane("sphere-plane", "columns"); // of many triangles
    MethodCase first{builtin, keys()};
    MethodCase second{builtin, keys()};
    first.draw_map();
    second.draw_map();
    const auto a = first.look_up(0.0005F);
    (void)second.look_up(0.25F);
    const auto b = second.look_up(0.0005F);
    ASSERT_EQ(a.samples.pixel_count(), b.samples.pixel_count());
    // Bytes: NaNs, too.
    EXPECT_EQ(std::memcmp(a.samples.data(), b.samples.data(),
                          a.samples.pixel_count() * sizeof(scene::LookupSample)),
              0);
    EXPECT_EQ(std::memcmp(a.texels.data(), b.texels.data(),
                          a.texels.pixel_count() * sizeof(scene::Vec2f)),
              0);
    if (methods::traits(first.job).curve == methods::Curve::by_bisection) {
        const auto of_a = first.find_critical_biases();
        const auto of_b = second.find_critical_biases();
        EXPECT_EQ(std::memcmp(of_a.data(), of_b.data(), of_a.pixel_count() * sizeof(float)), 0);
    }
}

/// Some plates whose sides are multiples of 1/8 m, at heights of 1/4 m.
std::vector<Plate> some_plates(unsigned seed)
{
    std::mt19937 random{seed};
    const auto between = [&](int low, int high) {
        return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    std::vector<Plate> plates;
    for (int i = 0; i < 5; ++i) {
        const double x = between(-26, 14) / 8.0;
        const double z = between(-26, 14) / 8.0;
        plates.push_back(
            {x, x + between(2, 14) / 8.0, z, z + between(2, 14) / 8.0, between(4, 28) / 4.0});
    }
    return plates;
}

std::string text(const std::vector<Plate>& plates)
{
    std::string all;
    for (const Plate& plate : plates) {
        all +=
            fmt::format(" [{},{}]x[{},{}] at {};", plate.x0, plate.x1, plate.z0, plate.z1, plate.y);
    }
    return all;
}

/// (x, z) ↦ (−x, z).
std::vector<Plate> mirrored(std::vector<Plate> plates)
{
    for (Plate& plate : plates) {
        plate = {-plate.x1, -plate.x0, plate.z0, plate.z1, plate.y};
    }
    return plates;
}
/// (x, z) ↦ (−z, x).
std::vector<Plate> quarter_turned(std::vector<Plate> plates)
{
    for (Plate& plate : plates) {
        plate = {-plate.z1, -plate.z0, plate.x0, plate.x1, plate.y};
    }
    return plates;
}

/// Largest difference of a texel's moments when summed in another order.
double step_of(const methods::Passes& passes)
{
    if (passes.prefilter.empty()) {
        return 0x1p-20;
    }
    switch (passes.prefilter.back().format) {
    case methods::TexelFormat::rg16:
    case methods::TexelFormat::rgba16:
        return 0x1p-16;
    case methods::TexelFormat::r16f:
    case methods::TexelFormat::rg16f:
    case methods::TexelFormat::rgba16f:
        return 0x1p-11; // of what is below 1
    case methods::TexelFormat::r32f:
    case methods::TexelFormat::rg32f:
    case methods::TexelFormat::rgba32f:
        return 0x1p-20; // a dozen sums, each by half of 2^-24
    }
    return 0;
}

/// Largest difference of two verdicts at mirrored or rotated places: 0 if texels are compared one
/// by one. If they are averaged, mirrored sums round differently, by a step in each of two passes.
/// All plates are at least g = 1/8 of the depth range above the ground. If a share s of the
/// footprint sees one, σ² is about s·g² and the receiver at least s·g beyond the mean. Chebyshev's
/// bound changes by at most 1/g² = 2^6 times the change of σ², which is three steps, plus 2/g = 2^4
/// times that of the mean: less than 2^8 steps.
double allowed_difference(const scene::Job& job)
{
    const LookupTraits promised = methods::traits(job);
    return promised.interpolates() && promised.has_fractions()
               ? 0x1p8 * 2 * step_of(methods::passes(job))
               : 0;
}

scene::LookupLayers looked_down(const std::vector<Plate>& plates, const scene::Job& job)
{
    MethodCase c{looking_down(job), plates_over_ground(plates)};
    c.draw_map();
    return c.look_up(0x1p-10F);
}

TEST_P(MethodThatTurns, MirrorsAndTurnsItsVerdictsWithTheScene)
{
    GNOMON_REQUIRE_GL();
    if (!shader_arithmetic_is_ieee()) {
        GTEST_SKIP() << "no promise of exact interpolation on this driver";
    }
    const scene::Job job = job_of_builtin("wall", keys());
    const double allowed = allowed_difference(job);
    for (unsigned seed = 1; seed <= in_lane(2U, 4U); ++seed) {
        const auto plates = some_plates(seed);
        SCOPED_TRACE(fmt::format("seed {}:{}", seed, text(plates)));
        const auto here = looked_down(plates, job);
        const auto there = looked_down(mirrored(plates), job);
        const auto turned = looked_down(quarter_turned(plates), job);
        const int last = here.samples.size().width_px - 1;
        std::size_t lit = 0;
        std::size_t shadowed = 0;
        for (int y = 0; y <= last; ++y) {
            for (int x = 0; x <= last; ++x) {
                const float verdict = here.samples(x, y).verdict;
                (verdict < 0.5F ? shadowed : lit) += 1;
                ASSERT_LE(std::abs(double{verdict} - double{there.samples(last - x, y).verdict}),
                          allowed)
                    << "mirrored: pixel " << x << ", " << y << ": " << verdict << " and "
                    << there.samples(last - x, y).verdict;
                ASSERT_LE(std::abs(double{verdict} - double{turned.samples(last - y, x).verdict}),
                          allowed)
                    << "turned: pixel " << x << ", " << y << ": " << verdict << " and "
                    << turned.samples(last - y, x).verdict;
            }
        }
        if (methods::traits(job).layers == 1) { // else light may reach under one plate
            EXPECT_GT(std::min(lit, shadowed), 250U);
        }
    }
}

double sum(const auto& amounts)
{
    return std::accumulate(amounts.begin(), amounts.end(), 0.0);
}

void expect_causes_add_up(const analysis::Comparison& result)
{
    const auto& causes = result.diagnosis->causes;
    const std::uint64_t wrong = result.metrics.false_shadow + result.metrics.false_lit;
    EXPECT_EQ(std::reduce(causes.counts.by_cause.begin(), causes.counts.by_cause.end()), wrong);
    EXPECT_EQ(std::reduce(causes.counts.by_label.begin(), causes.counts.by_label.end()), wrong);
    EXPECT_EQ(causes.counts.of(Cause::none), 0U);
    EXPECT_EQ(causes.counts.of(Label::none), 0U);
    const auto& amounts = result.metrics.amounts;
    // A pixel's amount is rounded to 2^-32 once or twice; the sums of doubles round.
    const double allowed =
        0x1p-31 * static_cast<double>(result.metrics.pixels.scored()) + 1e-12 * amounts.total();
    EXPECT_NEAR(sum(causes.amounts.by_cause) + amounts.unassigned, amounts.total(), allowed);
    EXPECT_NEAR(sum(causes.amounts.by_label) + amounts.unassigned, amounts.total(), allowed);
    EXPECT_EQ(causes.amounts.of(Cause::none), 0);
    EXPECT_EQ(causes.amounts.of(Label::none), 0);
}

/// Whether the usual lane also explains these errors: each value of each key, in three of twelve
/// cases.
bool is_explained(const std::string& builtin, const std::string& outside, const std::string& bias)
{
    return runs_full_tests() || (builtin == "wall" ? bias == "0" && outside == "clamp"
                                                   : bias == "0.01" && outside != "clamp");
}

TEST_P(ListedMethod, ExplainsEveryErrorOnce)
{
    GNOMON_REQUIRE_GL();
    const std::vector<scene::Override> size{{"image.width", "112"}, {"image.height", "63"}};
    for (const char* const builtin : {"sphere-cube", "wall"}) {
        const Compared scene{job_of_builtin(builtin, keys(size))};
        for (const char* const outside : {"lit", "shadowed", "clamp"}) {
            for (const char* const bias : {"0", "0.01"}) {
                if (!is_explained(builtin, outside, bias)) {
                    continue;
                }
                SCOPED_TRACE(fmt::format("{} {} bias {}", builtin, outside, bias));
                const auto result = scene(job_of_builtin(
                    builtin,
                    keys(with(size, {{"lookup.outside", outside}, {"bias.constant", bias}}))));
                if (methods::traits(result.job).has_map) {
                    EXPECT_GT(result.metrics.amounts.total(), 0);
                }
                expect_causes_add_up(result);
            }
        }
    }
}

/// Whether the usual lane also computes this curve: for each configuration in one scene, with one
/// slope.
bool is_curve_tried(const std::string& configuration, const std::string& builtin,
                    const std::string& slope)
{
    const bool is_plane = configuration.size() % 2 == 0;
    return runs_full_tests() || (is_plane ? builtin == "sphere-plane" && slope == "0.002"
                                          : builtin == "sphere-cube" && slope == "0");
}

TEST_P(MethodOfExactCurve, HasTheCurveThatGlsRerunsHave)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin : {"sphere-plane", "sphere-cube"}) {
        for (const char* const slope : {"0", "0.002"}) {
            if (!is_curve_tried(GetParam().label, builtin, slope)) {
                continue;
            }
            SCOPED_TRACE(fmt::format("{} slope {}", builtin, slope));
            std::vector<scene::Override> biased{{"bias.slope", slope}, {"bias.constant", "0.0005"}};
            if (!runs_full_tests()) {
                biased = with(biased, {{"image.width", "112"}, {"image.height", "63"}});
            }
            const scene::Job job = job_of_builtin(builtin, keys(biased));
            const Compared scene{job};
            const auto result = scene(job);
            ASSERT_TRUE(result.held.has_value());
            EXPECT_EQ(result.held->differences, 0U);
            EXPECT_FALSE(result.diagnosis->curve.verification.has_value())
                << "reruns contradict the curve";
            const auto verified = verify_comparison(result, scene.renderers());
            ASSERT_TRUE(verified.has_value());
            EXPECT_GE(verified->reruns.size(), 8U);
            for (const auto& rerun : verified->reruns) {
                EXPECT_EQ(rerun.differences, 0U) << "bias " << rerun.bias;
            }
        }
    }
}

/// The configurations with matching traits.
std::vector<Configuration> that(bool (*fit)(const LookupTraits&))
{
    auto all = configurations();
    std::erase_if(all, [&](const Configuration& one) {
        return !fit(methods::traits(job_of_builtin("wall", with(small, one.keys))));
    });
    return all;
}

bool compare_depths(const LookupTraits& promised)
{
    return promised.has_map && promised.compares != methods::Compares::primitives;
}

/// Whether the taps are symmetric under mirroring and quarter turns.
bool is_symmetric(const methods::ScatteredTaps& taps)
{
    const auto has = [&](const scene::Vec2f& place) {
        return std::ranges::find(taps.places, place) != taps.places.end();
    };
    return !taps.is_turned && std::ranges::all_of(taps.places, [&](const scene::Vec2f& place) {
        return has({-place.x, place.y}) && has({-place.y, place.x});
    });
}

bool turn(const LookupTraits& promised)
{
    return promised.compares != methods::Compares::primitives &&
           promised.monotonicity.how != Monotone::no && is_symmetric(promised.taps);
}

bool rise(const LookupTraits& promised)
{
    return promised.monotonicity.how != Monotone::no;
}

bool have_exact_curve(const LookupTraits& promised)
{
    return promised.has_curve() && promised.monotonicity.how == Monotone::exactly;
}

std::string name(const testing::TestParamInfo<Configuration>& info)
{
    std::string label = info.param.label;
    std::ranges::replace_if(
        label, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return label;
}

INSTANTIATE_TEST_SUITE_P(List, ListedMethod, testing::ValuesIn(configurations()), name);
INSTANTIATE_TEST_SUITE_P(List, MethodOfDepths, testing::ValuesIn(that(compare_depths)), name);
INSTANTIATE_TEST_SUITE_P(List, MethodThatTurns, testing::ValuesIn(that(turn)), name);
INSTANTIATE_TEST_SUITE_P(List, MethodThatRises, testing::ValuesIn(that(rise)), name);
INSTANTIATE_TEST_SUITE_P(List, MethodOfExactCurve, testing::ValuesIn(that(have_exact_curve)), name);

} // namespace
} // namespace gnomon::tests
