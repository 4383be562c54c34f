#include "analysis/metrics/map_depth_errors.hpp"

#include "fake_light.hpp"
#include "lookup_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::analysis {
namespace {

using scene::PixelClass;

scene::LightFrustum orthographic_frustum()
{
    scene::LightFrustum frustum;
    frustum.near_m = 2;
    frustum.far_m = 10;
    return frustum;
}

/// Four pixels looked up in one row of an 8×8 map: hit, missed by GL, rounded to far, not scored.
struct FourPixels {
    scene::Truth truth;
    scene::LookupLayers lookup;
    scene::Image<float> no_depths;
    FakeLight light;

    FourPixels()
    {
        truth.pixel_class = scene::Image<PixelClass>{{4, 1}, PixelClass::lit};
        truth.pixel_class[3] = PixelClass::attached;
        lookup.samples = scene::Image<scene::LookupSample>{{4, 1}, {0.5F, 0.5F, 0, 1}};
        lookup.texels = scene::Image<scene::Vec2f>{{4, 1}};
        for (int i = 0; i < 4; ++i) {
            lookup.texels(i, 0) = {static_cast<float>(i) + 0.25F, 3.5F};
            light.hits[{i, 3}] = {7, 0.5, 6.0};
        }
        lookup.samples[0].map_depth = 0.5625F;
        lookup.samples[1].map_depth = 1;
        lookup.samples[2].map_depth = 1;
        light.hits[{2, 3}] = {7, 0.999, 9.992};
    }

    [[nodiscard]] scene::Image<float> errors_m() const
    {
        const CauseInputs inputs{
            rule_of(scene::Filter::nearest), 8, truth, lookup, lookup, no_depths, light};
        const scene::LightFrustum map = orthographic_frustum();
        return map_depth_errors_m(inputs, CentreHits{inputs}, {&map, 1},
                                  {scene::DepthFormat::Kind::unorm, 8});
    }
};

TEST(MapDepthErrors, AreStoredLessExactWhereBothSeeSomething)
{
    const auto errors_m = FourPixels{}.errors_m();
    EXPECT_FLOAT_EQ(errors_m[0], 0.5F); // ζ 6.5 stored, 6 seen
    EXPECT_TRUE(std::isnan(errors_m[1])) << "GL saw nothing there";
    // 0.999 rounds to 1 in eight bits: 10 stored, 9.992 seen.
    EXPECT_NEAR(double{errors_m[2]}, 0.008, 1e-6); // of float32 near 10
    EXPECT_TRUE(std::isnan(errors_m[3])) << "not scored";
}

} // namespace
} // namespace gnomon::analysis
