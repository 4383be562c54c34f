// Blurred maps: light bleeding under three plates at equal memory, and monotonicity of verdicts in
// the bias at random places and biases.

#include "analysis/lookup/bias_order.hpp"
#include "blur_model.hpp"
#include "compared.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
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

/// The ground under a plate that hides all of it, and two plates above that each hide a part of it.
scene::SceneFile three_plates()
{
    return plates_over_ground({{-4, 4, -4, 4, 1}, {-2, 1, -1, 2, 4}, {-1, 2, -2, 1, 7}});
}

struct Bled {
    double amount = 0;
    std::uint64_t bytes = 0;
};

/// Light bleeding, in pixels.
Bled bled(const Compared& scene, const std::vector<scene::Override>& keys)
{
    const auto result =
        scene(looking_down(job_of_builtin("wall", with(keys, {{"shadow_map.depth_format", "d32f"},
                                                              {"lookup.outside", "clamp"},
                                                              {"bias.constant", "0"},
                                                              {"bias.slope", "0"},
                                                              {"bias.normal_texels", "0"}}))));
    return {result.diagnosis->causes.amounts.of(analysis::Label::bleed),
            methods::traits(result.job).map_bytes};
}

/// With 8 bytes per texel: the order published by Peters and Klein in 2015.
TEST(PrefilteredMaps, BleedInThePublishedOrderAtEqualBytes)
{
    GNOMON_REQUIRE_GL();
    const Compared scene{three_plates()};
    const Bled vsm = bled(scene, {{"method.name", "vsm"}});
    const Bled evsm = bled(scene, {{"method.name", "evsm"}, {"method.bits", "16"}});
    const Bled msm = bled(scene, {{"method.name", "msm"}, {"method.bits", "16"}});
    EXPECT_EQ(vsm.bytes, evsm.bytes);
    EXPECT_EQ(vsm.bytes, msm.bytes);
    EXPECT_GT(vsm.amount, evsm.amount);
    EXPECT_GT(evsm.amount, msm.amount);
    EXPECT_GT(msm.amount, 0);
}

using Keys = std::vector<scene::Override>;

struct Falls {
    std::uint64_t tries = 0;
    std::uint64_t monotonicity = 0;
    std::uint64_t falls = 0;
    double largest_fall = 0;
};

void compare_verdicts(MethodCase& c, float bias, float next, Falls& falls)
{
    const auto triangles = c.triangles();
    const auto lower = c.look_up(bias);
    const auto upper = c.look_up(next);
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        if (triangles[i] == scene::no_triangle) {
            continue;
        }
        const double rise = double{upper.samples[i].verdict} - double{lower.samples[i].verdict};
        ++falls.tries;
        falls.monotonicity += rise > 0 ? 1U : 0U;
        falls.falls += rise < 0 ? 1U : 0U;
        falls.largest_fall = std::max(falls.largest_fall, -rise);
    }
}

/// Compares each bias with the next one, with one a step of a receiver's depth away, and with a
/// random one.
void try_biases(MethodCase& c, std::mt19937& random, Falls& falls)
{
    std::uniform_real_distribution<double> share{-1, 1};
    for (int pair = 0; pair < 4; ++pair) {
        const float bias =
            static_cast<float>(std::copysign(std::exp2(-12 * share(random) - 13), share(random)));
        const float next = pair == 0   ? analysis::next_bias(bias)
                           : pair == 1 ? bias + 0x1p-24F
                           : pair == 2 ? bias + 0x1p-22F
                                       : bias + std::abs(bias);
        compare_verdicts(c, bias, next, falls);
    }
}

/// Over random maps, for at least this many lookups.
Falls falls_of(const std::string& method, const Keys& keys, std::uint64_t tries)
{
    std::mt19937 random{20250401};
    Falls falls;
    while (falls.tries < tries) {
        for (const char* const reversed : {"false", "true"}) {
            MethodCase c{"terrain",
                         with(with(model_keys(method), keys),
                              {{"shadow_map.reversed", reversed}, {"method.kernel_width", "3"}})};
            c.give_map(random_depths(random, model_side_texels));
            try_biases(c, random, falls);
        }
    }
    return falls;
}

struct RisingMap {
    const char* method;
    Keys keys;
};

std::vector<RisingMap> rising_maps()
{
    return {{"esm", {}},
            {"esm", {{"method.bits", "16"}}},
            {"esm", {{"method.exponent", "1000"}}},
            {"evsm", {}},
            {"evsm", {{"method.bits", "16"}}},
            {"evsm", {{"method.moments", "2"}, {"method.min_deviation", "0"}}},
            {"evsm", {{"method.positive_exponent", "10"}, {"method.bleeding_reduction", "0.15"}}}};
}

void expect_no_fall(std::uint64_t tries)
{
    for (const auto& [method, keys] : rising_maps()) {
        SCOPED_TRACE(fmt::format("{} {}", method, keys.empty() ? "" : keys[0].key));
        ASSERT_EQ(methods::traits(job_of_builtin("wall", with({{"method.name", method}}, keys)))
                      .monotonicity.how,
                  methods::Monotone::exactly);
        const Falls falls = falls_of(method, keys, tries);
        EXPECT_GE(falls.tries, tries);
        EXPECT_GT(falls.monotonicity, falls.tries / 200);
        EXPECT_EQ(falls.falls, 0U) << "by up to " << falls.largest_fall;
    }
}

TEST(PrefilteredMaps, NeverFallWithTheBias)
{
    GNOMON_REQUIRE_GL();
    expect_no_fall(100'000);
}

TEST(LongPrefilteredMaps, NeverFallWithTheBias)
{
    GNOMON_REQUIRE_GL();
    expect_no_fall(1'000'000);
}

/// docs/methods/msm.md states these.
void expect_falls_of_moments(std::uint64_t tries)
{
    for (const char* const bits : {"32", "16"}) {
        const Falls falls = falls_of("msm", {{"method.bits", bits}}, tries);
        SCOPED_TRACE(fmt::format("{} bits: {} of {} fall, by up to {}", bits, falls.falls,
                                 falls.tries, falls.largest_fall));
        EXPECT_GT(falls.falls, falls.tries / 20);
        EXPECT_LT(falls.falls, falls.tries / 5);
        EXPECT_GT(falls.largest_fall, 1e-4);
    }
}

TEST(MomentMap, FallsWithTheBiasNowAndThen)
{
    GNOMON_REQUIRE_GL();
    expect_falls_of_moments(100'000);
}

TEST(LongMomentMap, FallsWithTheBiasNowAndThen)
{
    GNOMON_REQUIRE_GL();
    expect_falls_of_moments(1'000'000);
}

} // namespace

} // namespace gnomon::tests
