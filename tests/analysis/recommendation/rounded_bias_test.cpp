#include "analysis/recommendation/rounded_bias.hpp"

#include <gtest/gtest.h>

namespace gnomon::analysis {
namespace {

scene::LightFrustum eight_metres()
{
    scene::LightFrustum frustum;
    frustum.near_m = 2;
    frustum.far_m = 10;
    return frustum;
}

TEST(RoundedBias, HasTwoDigitsWhereTheRunHoldsSuchABias)
{
    const RoundedBias rounded = rounded_bias(0.0074963F, {0.005F, 0.011F}, {}, eight_metres());
    EXPECT_EQ(rounded.key, "bias.constant = 0.0075");
    EXPECT_EQ(rounded.bias, 0.0075F);
}

TEST(RoundedBias, HasAsManyAsANarrowRunNeeds)
{
    const RoundedBias rounded = rounded_bias(0.23874F, {0.23872F, 0.238745F}, {}, eight_metres());
    EXPECT_EQ(rounded.key, "bias.constant = 0.23874");
    const float alone = 0.1F / 3;
    const RoundedBias exact = rounded_bias(alone, {alone, alone}, {}, eight_metres());
    EXPECT_EQ(exact.bias, alone);
    EXPECT_EQ(static_cast<float>(std::stod(exact.key.substr(exact.key.find('=') + 1))), alone);
}

TEST(RoundedBias, IsToldInMetresAsTheJobTells)
{
    scene::BiasSettings settings;
    settings.constant_m = 0.5;
    const RoundedBias rounded = rounded_bias(0.01234F, {0.01F, 0.02F}, settings, eight_metres());
    EXPECT_EQ(rounded.key, "bias.constant_m = 0.099");
    EXPECT_EQ(rounded.bias, static_cast<float>(0.099 / 8));
}

TEST(RoundedBias, OfZeroIsZero)
{
    EXPECT_EQ(rounded_bias(0, {0, 1}, {}, eight_metres()).key, "bias.constant = 0");
}

} // namespace
} // namespace gnomon::analysis
