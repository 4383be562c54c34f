#include "analysis/depth/bin_envelopes.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace gnomon::analysis {
namespace {

TEST(BinEnvelopes, AreTheFormulasAtTheUpperEdgeBetweenNearAndFar)
{
    scene::LightFrustum frustum;
    frustum.projection = scene::Projection::perspective;
    frustum.near_m = 4;
    frustum.far_m = 50;
    std::vector<ErrorBin> bins(3);
    bins[0].upper = 3;
    bins[1].upper = 50;
    bins[2].upper = 60;
    add_envelopes(bins, frustum, {scene::DepthFormat::Kind::d16, 16});
    // The table of docs/depth_precision.md, to its digits.
    EXPECT_NEAR(bins[0].envelope_m.value(), 2.81e-5, 0.005e-5);
    EXPECT_NEAR(bins[1].envelope_m.value(), 4.3874e-3, 0.00005e-3);
    EXPECT_EQ(bins[2].envelope_m, bins[1].envelope_m);
}

TEST(BinEnvelopes, AreConstantForAnOrthographicMap)
{
    scene::LightFrustum frustum;
    frustum.near_m = -1;
    frustum.far_m = 3;
    std::vector<ErrorBin> bins(2);
    bins[0].upper = 0;
    bins[1].upper = 3;
    add_envelopes(bins, frustum, {scene::DepthFormat::Kind::unorm, 8});
    EXPECT_DOUBLE_EQ(bins[0].envelope_m.value(), 0.5 / 255 * 4);
    EXPECT_DOUBLE_EQ(bins[1].envelope_m.value(), 0.5 / 255 * 4);
}

} // namespace
} // namespace gnomon::analysis
