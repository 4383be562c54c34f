#include "analysis/rays/first_hit_cache.hpp"

#include "fake_light.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::analysis {
namespace {

using scene::Cull;
using scene::Texel;
using ::testing::ElementsAre;

const std::vector<Texel> texels{{1, 2}, {16383, 0}, {3, 16383}};

scene::LightFrustum frustum_from(double near_m)
{
    scene::LightFrustum frustum;
    frustum.near_m = near_m;
    return frustum;
}

/// The light sees triangles 7 and 9, and nothing through the last texel.
void show(FakeLight& light)
{
    light.hits[{1, 2}] = {7, 0.25, 3, 0};
    light.hits[{16383, 0}] = {9, 0.5, 4, 0};
}

/// Queries a cache for a map with this near plane.
void ask(FirstHitCache& cache, FakeLight& light, double near_m, int resolution_texels = 16384,
         Cull cull = Cull::none, const std::vector<Texel>& of = texels)
{
    const scene::LightFrustum frustum = frustum_from(near_m);
    const auto hits = cache.first_hits({light, {&frustum, 1}, resolution_texels, cull}, of);
    ASSERT_EQ(hits.size(), of.size());
    for (std::size_t i = 0; i < of.size(); ++i) {
        const auto expected = light.hits.find({of[i].x, of[i].y});
        EXPECT_EQ(hits[i].triangle,
                  expected == light.hits.end() ? scene::no_triangle : expected->second.triangle);
    }
}

TEST(FirstHitCache, TellsWhatWasSeenFromANearerPlane)
{
    FirstHitCache cache{3};
    FakeLight light;
    show(light);
    ask(cache, light, 0.5);
    EXPECT_EQ(light.traced_texels, 3U);
    EXPECT_TRUE(light.known_frusta.empty());
    ask(cache, light, 1);
    ask(cache, light, 0.5);
    EXPECT_EQ(light.traced_texels, 3U);
    ASSERT_EQ(light.known_frusta.size(), 2U);
    for (const scene::LightFrustum& known : light.known_frusta) {
        EXPECT_EQ(known.near_m, 0.5);
    }
    EXPECT_THAT(light.known_triangles[0], ElementsAre(7U, 9U, scene::no_triangle));
}

TEST(FirstHitCache, StartsAnewFromTheNearestPlane)
{
    FirstHitCache cache{3};
    FakeLight light;
    show(light);
    ask(cache, light, 1);
    ask(cache, light, 0.5);
    EXPECT_EQ(light.traced_texels, 6U);
    ask(cache, light, 0.75);
    ASSERT_EQ(light.known_frusta.size(), 1U);
    EXPECT_EQ(light.known_frusta[0].near_m, 0.5);
}

TEST(FirstHitCache, TellsMapsApart)
{
    FirstHitCache cache{100};
    FakeLight light;
    show(light);
    ask(cache, light, 1);
    ask(cache, light, 2, 8192);
    ask(cache, light, 2, 16384, Cull::back);
    EXPECT_TRUE(light.known_frusta.empty());
    ask(cache, light, 2, 16384, Cull::none, {texels[0], texels[1]}); // like another camera's
    ask(cache, light, 2, 16384, Cull::none, {texels[1], texels[0]});
    EXPECT_TRUE(light.known_frusta.empty());
    ask(cache, light, 3, 8192);
    ask(cache, light, 3, 16384, Cull::back);
    EXPECT_EQ(light.known_frusta.size(), 2U);
}

TEST(FirstHitCache, KnowsTheTexelsOfAMapThatStaysBesideAnother)
{
    FirstHitCache cache{100};
    FakeLight light;
    show(light);
    std::vector<scene::LightFrustum> maps{frustum_from(1), frustum_from(1)};
    const std::vector<Texel> before{{1, 2, 0}, {16383, 0, 0}, {1, 2, 1}};
    (void)cache.first_hits({light, maps, 16384}, before);
    EXPECT_EQ(light.traced_texels, 3U);
    maps[1].light_clip_from_world[3][0] = 0.5F; // moved aside
    const std::vector<Texel> after{{16383, 0, 0}, {5, 5, 1}, {4, 4, 0}};
    (void)cache.first_hits({light, maps, 16384}, after);
    ASSERT_EQ(light.known_triangles.size(), 1U);
    EXPECT_THAT(light.known_triangles[0], ElementsAre(9U, scene::no_triangle, scene::no_triangle));
    maps[0].light_clip_from_world[3][0] = 0.25F;
    maps[1].light_clip_from_world[3][0] = 0.25F;
    (void)cache.first_hits({light, maps, 16384}, before); // of other maps
    EXPECT_EQ(light.known_triangles.size(), 1U);
}

TEST(FirstHitCache, TakesNoMoreThanItMay)
{
    FirstHitCache cache{5};
    FakeLight light;
    show(light);
    ask(cache, light, 1);
    ask(cache, light, 1, 8192); // no room
    ask(cache, light, 2, 8192);
    EXPECT_TRUE(light.known_frusta.empty());
    ask(cache, light, 1, 4096, Cull::none, {texels[0], texels[1]}); // the remaining room
    ask(cache, light, 2, 4096, Cull::none, {texels[0], texels[1]});
    ask(cache, light, 2);
    EXPECT_EQ(light.known_frusta.size(), 2U);
    ask(cache, light, 0.5); // replaces its own entry
    ask(cache, light, 0.75);
    EXPECT_EQ(light.known_frusta.size(), 3U);
}

} // namespace
} // namespace gnomon::analysis
