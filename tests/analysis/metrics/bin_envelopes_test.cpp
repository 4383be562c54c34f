#include "analysis/depth/depth_error.hpp"
#include "analysis/metrics/bin_envelopes.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace gnomon::analysis {
namespace {

TEST(BinEnvelopes, AreTheFormulasBetweenNearAndFar)
{
    scene::LightFrustum frustum;
    frustum.projection = scene::Projection::perspective;
    frustum.near_m = 4;
    frustum.far_m = 50;
    std::vector<ErrorBin> bins(3);
    bins[0].upper = 3;
    bins[1].upper = 50;
    bins[2].upper = 60;
    add_envelopes(bins, {&frustum, 1}, {scene::DepthFormat::Kind::d16, 16});
    // The table of docs/depth_precision.md, to its digits.
    EXPECT_NEAR(bins[0].envelope_m.value(), 2.81e-5, 0.005e-5);
    EXPECT_NEAR(bins[1].envelope_m.value(), 4.3874e-3, 0.00005e-3);
    EXPECT_EQ(bins[2].envelope_m, bins[1].envelope_m);
}

TEST(BinEnvelopes, HoldForTheWholeBinWhereTheFormulaFalls)
{
    scene::LightFrustum frustum;
    frustum.projection = scene::Projection::perspective;
    frustum.near_m = 4;
    frustum.far_m = 50;
    frustum.reversed = true;
    frustum.clip_range = scene::ClipRange::zero_to_one;
    const DepthMapping mapping{frustum.depth_range()};
    std::vector<ErrorBin> bins(1);
    bins[0].lower = 30;
    bins[0].upper = 50;
    add_envelopes(bins, {&frustum, 1}, {scene::DepthFormat::Kind::d32f, 32});
    EXPECT_GE(bins[0].envelope_m.value(), error_envelope_m(mapping, DepthCoding::float32(), 30));
    EXPECT_GT(bins[0].envelope_m.value(),
              10 * error_envelope_m(mapping, DepthCoding::float32(), 49.9));
}

TEST(BinEnvelopes, AreConstantForAnOrthographicMap)
{
    scene::LightFrustum frustum;
    frustum.near_m = -1;
    frustum.far_m = 3;
    std::vector<ErrorBin> bins(2);
    bins[0].upper = 0;
    bins[1].upper = 3;
    add_envelopes(bins, {&frustum, 1}, {scene::DepthFormat::Kind::unorm, 8});
    EXPECT_DOUBLE_EQ(bins[0].envelope_m.value(), 0.5 / 255 * 4);
    EXPECT_DOUBLE_EQ(bins[1].envelope_m.value(), 0.5 / 255 * 4);
}

} // namespace
} // namespace gnomon::analysis
