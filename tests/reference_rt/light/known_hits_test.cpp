#include "reference_rt/light/texel_first_hits.hpp"

#include "lane.hpp"
#include "light_fixture.hpp"

#include <gtest/gtest.h>

namespace gnomon::reference_rt::test {
namespace {

using renderers::KnownHits;

/// Near planes before the scene, in the middle of it, and behind most of it: it is up to 4 m away.
constexpr std::array nears_m{0.25, 0.2500001, 1.0, 2.5, 3.25};

std::vector<std::uint32_t> triangles_of(const std::vector<TexelHit>& hits)
{
    std::vector<std::uint32_t> triangles;
    std::ranges::transform(hits, std::back_inserter(triangles), &TexelHit::triangle);
    return triangles;
}

void expect_same(const std::vector<TexelHit>& found, const std::vector<TexelHit>& expected)
{
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].triangle, expected[i].triangle) << "texel " << i;
        ASSERT_EQ(found[i].depth, expected[i].depth) << "texel " << i;
        ASSERT_EQ(found[i].depth_error, expected[i].depth_error) << "texel " << i;
        ASSERT_EQ(found[i].light_distance_m, expected[i].light_distance_m) << "texel " << i;
    }
}

LightCase with_near(LightCase light, double near_m)
{
    light.frustum.near_m = near_m;
    light.frustum.far_m = 12;
    return light;
}

TEST(KnownHits, GiveWhatTracingGives)
{
    const unsigned seeds = tests::in_lane(2U, 30U);
    for (const LightCase& light : light_cases()) {
        for (unsigned seed = 1; seed <= seeds; ++seed) {
            for (const double before_m : nears_m) {
                const LightCase from = with_near(light, before_m);
                const LitScene before{random_sheets(seed, seed % 2 == 0), from.light, from.frustum};
                const auto texels = before.all_texels();
                const auto triangles =
                    triangles_of(before.light_queries()->first_hits(texels, HitDetail::placed));
                for (const double near_m : nears_m) {
                    SCOPED_TRACE(testing::Message() << light.name << ", seed " << seed << ", near "
                                                    << before_m << ", then " << near_m);
                    const LightCase to = with_near(light, near_m);
                    const LitScene lit{random_sheets(seed, seed % 2 == 0), to.light, to.frustum};
                    const auto exact = lit.light_queries();
                    expect_same(exact->first_hits(texels, KnownHits{before.view.maps, triangles}),
                                exact->first_hits(texels, HitDetail::placed));
                }
            }
        }
    }
}

TEST(KnownHits, HoldForASpotFurtherFromTheNearPlaneOn)
{
    int spots = 0;
    for (const LightCase& light : light_cases()) {
        SCOPED_TRACE(light.name);
        const auto frustum = [&](double near_m) {
            const LightCase moved = with_near(light, near_m);
            return LitScene{random_sheets(1, false), moved.light, moved.frustum}.view;
        };
        const View near = frustum(1);
        const View far = frustum(2.5);
        const bool is_spot = near.light.type == scene::LightType::spot;
        spots += is_spot ? 1 : 0;
        EXPECT_EQ(keeps_first_hits(near.light, near.first_map(), far.first_map()), is_spot);
        EXPECT_FALSE(keeps_first_hits(near.light, far.first_map(), near.first_map()));
        EXPECT_TRUE(keeps_first_hits(near.light, near.first_map(), near.first_map()));
        scene::LightFrustum turned = far.first_map();
        turned.light_clip_from_world[0][0] *= 1.0000002F;
        EXPECT_FALSE(keeps_first_hits(near.light, near.first_map(), turned));
    }
    EXPECT_GT(spots, 0);
}

TEST(KnownHits, AreRefusedWhereTheyAreNone)
{
    const LightCase light = light_cases().back();
    const LitScene lit{random_sheets(1, false), light.light, light.frustum};
    const auto exact = lit.light_queries();
    const auto texels = lit.all_texels();
    const std::vector<std::uint32_t> too_few(texels.size() - 1, no_triangle);
    EXPECT_THROW((void)exact->first_hits(texels, KnownHits{lit.view.maps, too_few}),
                 std::invalid_argument);
    const std::vector<std::uint32_t> strange(texels.size(), 1'000'000);
    EXPECT_THROW((void)exact->first_hits(texels, KnownHits{lit.view.maps, strange}),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::reference_rt::test
