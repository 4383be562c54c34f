// The constant biases that `compare` recommends, checked by running GL with them.

#include "child_process.hpp"
#include "lane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
using Keys = std::vector<std::string>; ///< "KEY=VALUE"

/// A comparison of a built-in scene at 160 × 90 pixels.
Json compared(const std::string& builtin, const Keys& keys)
{
    std::vector<std::string> arguments{"compare", "--builtin",       builtin, "--json",
                                       "--set",   "image.width=160", "--set", "image.height=90"};
    for (const std::string& key : keys) {
        arguments.insert(arguments.end(), {"--set", key});
    }
    const Ending ending = gnomon(arguments);
    expect_done(ending);
    return ending.exit_code == 0 ? Json::parse(ending.out) : Json::object();
}

Json with_bias(const std::string& builtin, Keys keys, const Json& bias)
{
    keys.push_back("bias.constant=" + bias.dump());
    return compared(builtin, keys);
}

std::int64_t number(const Json& json, const char* name)
{
    return json.at(name).get<std::int64_t>();
}

/// The next larger float32 of a positive one.
Json next_float(const Json& value)
{
    return std::nextafter(value.get<float>(), std::numeric_limits<float>::infinity());
}

TEST(RecommendedBias, LeavesThreeTexelsAboveItsValleysLowerEnd)
{
    const Json curve = compared("sphere-plane", {}).at("bias_curve").at("recommended");
    // Each float32 bias is rounded by at most one part in 2^24.
    EXPECT_NEAR(curve.at("bias_texels").get<double>() - curve.at("low_texels").get<double>(), 3,
                1e-3);
}

TEST(RecommendedBias, KeepsTheShadowOfWhatIsPutOnTheGround)
{
    // A bias recommended for a ball in the air keeps most of the shadow once the ball is on the
    // ground: it has a margin of three texels, not the whole gap.
    const Json bias = compared("sphere-plane", {}).at("bias_curve").at("recommended").at("bias");
    const Json down = with_bias("sphere-plane", {"scene.sphere-plane.sphere_height_m=1"}, bias);
    EXPECT_LT(down.at("false_lit_rate").get<double>(), 0.5);
}

TEST(RecommendedBias, IsFollowedByWhatItCosts)
{
    const Json recommended = compared("sphere-plane", {}).at("bias_curve").at("recommended");
    ASSERT_GE(recommended.at("sentences").size(), 2U);
    EXPECT_THAT(recommended.at("sentences")[0].get<std::string>(), HasSubstr("nearly as good"));
    EXPECT_THAT(recommended.at("sentences")[1].get<std::string>(),
                HasSubstr("casts no shadow there"));
}

/// A blurred map whose softened borders hide the bias's errors: counted with softening, the least
/// error would be to light every shadow.
const Keys blurred_fence{"shadow_map.resolution=256",
                         "scene.fence.slat_width_m=0.06",
                         "method.name=vsm",
                         "method.kernel_width=9",
                         "bias.slope=0",
                         "bias.normal_texels=0",
                         tests::in_lane("image.width=96", "image.width=160"),
                         tests::in_lane("image.height=54", "image.height=90")};

TEST(RecommendedBias, LeavesNoMoreThanNoBiasDoes)
{
    const Json without = with_bias("fence", blurred_fence, 0);
    const Json& curve = without.at("bias_curve");
    const Json with = with_bias("fence", blurred_fence, curve.at("recommended").at("bias"));
    EXPECT_LE(with.at("error_amount").get<double>(), without.at("error_amount").get<double>());
}

TEST(RecommendedBias, IsNoneThatLightsAllShadowsAndCallsThemSoft)
{
    for (const std::string resolution : {"256", "512"}) {
        if (!tests::runs_full_tests() && resolution == "256") {
            continue; // other tests cover it in the usual lane
        }
        Keys keys = blurred_fence;
        keys.front() = "shadow_map.resolution=" + resolution;
        const Json without = with_bias("fence", keys, 0);
        const Json with =
            with_bias("fence", keys, without.at("bias_curve").at("recommended").at("bias"));
        // The blur alone lights most of these thin shadows.
        EXPECT_LT(number(with, "false_lit"),
                  number(without, "false_lit") + number(with.at("pixels"), "blocked") / 2)
            << resolution;
    }
}

TEST(ErrorAmount, LeavesOutNoMoreSofteningThanWithoutABias)
{
    const Json without = with_bias("fence", blurred_fence, 0);
    const Json lit = with_bias("fence", blurred_fence, 1);
    ASSERT_GT(lit.at("light_softening").get<double>(), without.at("light_softening").get<double>())
        << "a bias of 1 lights every shadow";
    const double both =
        lit.at("shadow_amount").get<double>() + lit.at("light_amount").get<double>();
    const double most = without.at("softening").get<double>();
    EXPECT_GE(lit.at("error_amount").get<double>(), both - most);
    EXPECT_DOUBLE_EQ(without.at("error_amount").get<double>(),
                     without.at("shadow_amount").get<double>() +
                         without.at("light_amount").get<double>() - most);
}

struct LimitedJob {
    const char* builtin;
    Keys keys;
};

class PeterPanningFree : public ::testing::TestWithParam<LimitedJob> {};
INSTANTIATE_TEST_SUITE_P(Jobs, PeterPanningFree,
                         ::testing::Values(LimitedJob{"sphere-plane", {}}, LimitedJob{"yard", {}},
                                           LimitedJob{"columns", {"lookup.filter=pcf3"}},
                                           LimitedJob{"fence", {"lookup.filter=hardware"}},
                                           LimitedJob{"wall", {"bias.normal_texels=2"}},
                                           LimitedJob{"sphere-cube", {"bias.slope=0.01"}}));

TEST_P(PeterPanningFree, IsTheLargestBiasWithoutAPixelThatIsCalledSo)
{
    const auto& [builtin, keys] = GetParam();
    const Json curve = with_bias(builtin, keys, 0).at("bias_curve");
    const Json& free = curve.at("peter_panning_free");
    if (free.is_null()) {
        const Json any = with_bias(builtin, keys, 1);
        EXPECT_EQ(number(any.at("labels"), "peter_panning") == 0,
                  number(with_bias(builtin, keys, 0).at("labels"), "peter_panning") == 0);
        return;
    }
    EXPECT_EQ(number(with_bias(builtin, keys, free).at("labels"), "peter_panning"), 0);
    EXPECT_GT(number(with_bias(builtin, keys, next_float(free)).at("labels"), "peter_panning"), 0);
}

TEST_P(PeterPanningFree, TellsApartWhatIsLitForOtherReasons)
{
    const auto& [builtin, keys] = GetParam();
    const Json at_zero = with_bias(builtin, keys, 0);
    EXPECT_EQ(number(at_zero.at("bias_curve"), "lit_at_zero"),
              number(at_zero, "false_lit") - number(at_zero.at("labels"), "peter_panning"));
    const Json elsewhere = with_bias(builtin, keys, 0.01);
    EXPECT_EQ(elsewhere.at("bias_curve").at("lit_at_zero"),
              at_zero.at("bias_curve").at("lit_at_zero"));
    EXPECT_EQ(elsewhere.at("bias_curve").at("peter_panning_free"),
              at_zero.at("bias_curve").at("peter_panning_free"));
}

} // namespace
} // namespace gnomon::testing
