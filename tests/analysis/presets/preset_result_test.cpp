#include "analysis/presets/preset_result.hpp"
#include "methods/key_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace gnomon::analysis {
namespace {

/// A map of 64² from -1 to 1 across, or at ζ = 1, and from 2 to 10 along.
scene::View one_map(scene::Projection projection)
{
    scene::LightFrustum frustum;
    frustum.projection = projection;
    frustum.near_m = 2;
    frustum.far_m = 10;
    scene::View view;
    view.maps = {frustum};
    return view;
}

scene::Job job_of_64(scene::DepthFormat format)
{
    scene::Job job;
    job.keys = methods::key_table();
    job.shadow_map.resolution_texels = 64;
    job.shadow_map.depth_format = format;
    return job;
}

constexpr scene::DepthFormat d16{scene::DepthFormat::Kind::d16, 16};
constexpr double receiver_m = 4;

TEST(ReceiverBias, IsTheSameLengthInEveryUnitUnderAParallelLight)
{
    scene::View view = one_map(scene::Projection::orthographic);
    view.bias = {.constant = 0.25F, .slope = 0.5F, .normal_texels = 3};
    const ReceiverBias at = bias_at(job_of_64(d16), view, receiver_m);
    EXPECT_EQ(at.texel_m, 1.0 / 32);
    EXPECT_EQ(at.bias.constant, 0.25);
    EXPECT_EQ(at.bias.constant_m, 2); // of a range of 8 m
    EXPECT_EQ(at.bias.constant_texels, 64);
    EXPECT_DOUBLE_EQ(at.constant_r, 0.25 * 65535);
    EXPECT_EQ(at.slope, 0.5);
    EXPECT_EQ(at.bias.slope_m, 4);
    EXPECT_EQ(at.normal_texels, 3);
    EXPECT_EQ(at.bias.normal_offset_m, 3.0 / 32);
}

TEST(ReceiverBias, IsThatOfTheReceiversDistanceUnderASpot)
{
    scene::View view = one_map(scene::Projection::perspective);
    view.bias.constant = 0.25F;
    const ReceiverBias at = bias_at(job_of_64(d16), view, receiver_m);
    EXPECT_EQ(at.texel_m, receiver_m / 32);
    // A b ζ² / (1 + A b ζ) with A = 1/2 − 1/10: 1.6 / 1.4.
    EXPECT_DOUBLE_EQ(at.bias.constant_m, 1.6 / 1.4);
    EXPECT_DOUBLE_EQ(at.bias.constant_texels, 1.6 / 1.4 * 8);
}

TEST(ReceiverBias, HasFinerStepsNearerToZeroInFloats)
{
    scene::View view = one_map(scene::Projection::orthographic);
    view.bias.constant = 0.25F;
    // Depth 1/4 at 4 m of 2 to 10: steps of 2^-25.
    EXPECT_EQ(bias_at(job_of_64(scene::float_depth_format), view, receiver_m).constant_r,
              0.25 * 0x1p25);
}

FurtherBias further_bias(const scene::Job& job, const scene::View& view)
{
    const auto further = further_bias_at(job, view, receiver_m);
    return further.value_or(FurtherBias{});
}

TEST(FurtherBias, AddsTexelsAndUnitsAndMakesASlopeOfTheFactor)
{
    scene::Job job = job_of_64(d16);
    job.method.values["bias.constant_texels"] = 1.0;
    job.method.values["bias.polygon_offset_factor"] = 2.0;
    scene::View view = one_map(scene::Projection::orthographic);
    view.bias.added = {{"bias.polygon_offset_factor", 2.0F}, {"bias.polygon_offset_units", 4.0F}};
    const FurtherBias further = further_bias(job, view);
    const double texel_in_depth = 1.0 / 32 / 8;
    EXPECT_DOUBLE_EQ(further.constant, texel_in_depth + 4.0 / 65535);
    EXPECT_DOUBLE_EQ(further.constant_m, 8 * further.constant);
    EXPECT_DOUBLE_EQ(further.constant_texels, 8 * further.constant * 32);
    EXPECT_DOUBLE_EQ(further.constant_r, texel_in_depth * 65535 + 4);
    EXPECT_DOUBLE_EQ(further.slope_m, 2.0 / 32);
}

TEST(FurtherBias, TakesTheDriversUnitWhereItWasMeasured)
{
    scene::Job job = job_of_64(d16);
    job.method.values["bias.polygon_offset_units"] = 4.0;
    scene::View view = one_map(scene::Projection::orthographic);
    view.bias.added = {{"bias.polygon_offset_units", 4.0F}};
    const auto further = further_bias_at(job, view, receiver_m, 0x1p-15);
    ASSERT_TRUE(further);
    EXPECT_EQ(further->constant, 0x1p-13);
}

TEST(FurtherBias, CountsNegativeUnitsOfAReversedMapAsAwayFromTheLight)
{
    scene::Job job = job_of_64(d16);
    job.method.values["bias.polygon_offset_units"] = -4.0;
    scene::View view = one_map(scene::Projection::orthographic);
    view.maps.front().reversed = true;
    view.bias.added = {{"bias.polygon_offset_units", -4.0F}};
    EXPECT_DOUBLE_EQ(further_bias(job, view).constant_r, 4);
}

TEST(FurtherBias, NamesTheKeysThatAreNotAtTheirDefaults)
{
    scene::Job job = job_of_64(d16);
    job.bias.normal_texels = 2;
    job.method.values["bias.adaptive_m"] = 0.0;
    job.method.values["bias.receiver_plane"] = std::string{"analytic"};
    const FurtherBias further = further_bias(job, one_map(scene::Projection::orthographic));
    ASSERT_EQ(further.keys.size(), 1U);
    EXPECT_EQ(further.keys.begin()->first, "bias.receiver_plane");
    EXPECT_EQ(further.constant, 0);
}

TEST(FurtherBias, IsNoneOfAJobThatNamesNone)
{
    EXPECT_FALSE(
        further_bias_at(job_of_64(d16), one_map(scene::Projection::orthographic), receiver_m));
}

} // namespace
} // namespace gnomon::analysis
