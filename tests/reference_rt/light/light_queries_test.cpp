#include "lane.hpp"
#include "light_fixture.hpp"

#include <gtest/gtest.h>

namespace gnomon::reference_rt::test {
namespace {

constexpr std::array culls{Cull::none, Cull::front, Cull::back};

TEST(FirstHits, AreThoseOfBruteForceInRationals)
{
    int hits = 0;
    std::size_t number = 0;
    for_each_case([&](const LitScene& lit) {
        ++number;
        for (const Cull cull : culls) {
            if (!tests::runs_full_tests() && number++ % std::size(culls) != 0) {
                continue; // the usual lane culls each scene in one way
            }
            const auto texels = lit.all_texels();
            const auto light = lit.light_queries(cull);
            const auto found = light->first_hits(texels, HitDetail::placed);
            const auto bounded = light->first_hits(texels, HitDetail::bounded);
            ASSERT_EQ(found.size(), texels.size());
            ASSERT_EQ(bounded.size(), texels.size());
            for (std::size_t i = 0; i < texels.size(); ++i) {
                const scene::Ray ray = lit.texel_ray(texels[i]);
                const Passing first = first_hit_of(lit.triangles, lit.view, ray, cull);
                ASSERT_EQ(found[i].triangle, first.triangle)
                    << "texel " << texels[i].x << ' ' << texels[i].y << ", cull "
                    << scene::cull_name(cull);
                ASSERT_EQ(bounded[i].triangle, first.triangle);
                if (first.triangle == no_triangle) {
                    EXPECT_EQ(bounded[i].depth, found[i].depth);
                    EXPECT_EQ(bounded[i].depth_error, 0);
                    EXPECT_EQ(found[i].depth, lit.view.first_map().reversed ? 0 : 1);
                    EXPECT_EQ(found[i].light_distance_m, std::numeric_limits<double>::infinity());
                    continue;
                }
                ++hits;
                const RationalVec point =
                    RationalVec{ray.origin} + first.t * RationalVec{ray.direction};
                const Rational depth = *matrix_depth(lit.view.first_map(), point);
                EXPECT_LE(abs(depth - Rational{found[i].depth}), Rational{found[i].depth_error});
                EXPECT_LE(found[i].depth_error, 0x1p-48);
                EXPECT_LE(abs(depth - Rational{bounded[i].depth}),
                          Rational{bounded[i].depth_error});
                EXPECT_LE(bounded[i].depth_error, 0x1p-40);
                const Rational light_distance =
                    dot(RationalVec{lit.view.first_map().forward},
                        point - RationalVec{lit.view.first_map().origin});
                EXPECT_LE(abs(light_distance - Rational{found[i].light_distance_m}),
                          0x1p-44 * abs(light_distance));
            }
        }
    });
    EXPECT_GT(hits, tests::in_lane(1000, 3000));
}

TEST(AreCrossed, IsWhatBruteForceInRationalsSays)
{
    int crossed = 0;
    int pixels_tried = 0;
    std::size_t number = 0;
    for_each_case([&](const LitScene& lit) {
        ++number;
        const auto pixels = lit.scored_pixels();
        for (const Cull cull : culls) {
            if (!tests::runs_full_tests() && number++ % std::size(culls) != 0) {
                continue; // the usual lane culls each scene in one way
            }
            const auto answers = lit.light_queries(cull)->occluded(pixels, {});
            for (std::size_t i = 0; i < pixels.size(); i += 3) {
                const bool expected =
                    is_crossed(lit.triangles, lit.view, lit.point(pixels[i]), cull);
                ASSERT_EQ(answers[i], expected ? 1 : 0)
                    << "pixel " << pixels[i] << ", cull " << scene::cull_name(cull);
                crossed += expected ? 1 : 0;
                ++pixels_tried;
            }
        }
    });
    EXPECT_GT(crossed, tests::in_lane(100, 300));
    EXPECT_GT(pixels_tried - crossed, tests::in_lane(100, 300));
}

/// A tap with what is known of its depth, or without.
ExactTap tap_of(Texel texel, const TexelHit& hit, bool is_known)
{
    return hit.triangle == no_triangle ? ExactTap{texel, no_triangle, 0.75, 0}
           : is_known                  ? ExactTap{texel, hit.triangle, hit.depth, hit.depth_error}
                                       : ExactTap{texel, hit.triangle};
}

float expected_bias(const LitScene& lit, std::size_t pixel, const Rational& depth, bool clamps)
{
    Rational r = *matrix_depth(lit.view.first_map(), lit.point(pixel));
    if (clamps) {
        r = r < 0 ? Rational{0} : r > 1 ? Rational{1} : r;
    }
    return smallest_bias(lit.view.first_map().reversed ? Rational{depth - r} : Rational{r - depth});
}

TEST(CriticalBiases, AreThoseOfRationalsForOneTap)
{
    for_each_case([&](const LitScene& lit) {
        std::mt19937 random{7};
        const auto light = lit.light_queries();
        const auto texels = lit.all_texels();
        const auto hits = light->first_hits(texels, HitDetail::bounded);
        std::vector<NearestQuery> queries;
        for (const std::size_t pixel : lit.scored_pixels()) {
            const std::size_t texel = random() % texels.size();
            queries.push_back({pixel, tap_of(texels[texel], hits[texel], random() % 2 == 0)});
        }
        for (const bool clamps : {false, true}) {
            const auto biases = light->critical_biases(std::span{queries}, {clamps});
            for (std::size_t i = 0; i < queries.size(); ++i) {
                EXPECT_EQ(biases[i], expected_bias(lit, queries[i].pixel,
                                                   tap_depth(lit, queries[i].tap), clamps))
                    << "pixel " << queries[i].pixel;
            }
        }
    });
}

/// uv·n of a pixel's point.
std::array<Rational, 2> place_on_map(const LitScene& lit, std::size_t pixel)
{
    const ClipRows rows{lit.view.first_map()};
    const RationalVec point = lit.point(pixel);
    const auto at = [&](const scene::Vec4d& row) {
        return dot(RationalVec{scene::Vec3d{row}}, point) + Rational{row.w};
    };
    const auto along = [&](const scene::Vec4d& axis) {
        return Rational{lit.resolution * (at(axis) / at(rows.w) + 1) / 2};
    };
    return {along(rows.x), along(rows.y)};
}

int floor_of(const Rational& x)
{
    const auto nearest = static_cast<int>(std::floor(static_cast<double>(x)));
    return Rational{nearest} > x ? nearest - 1 : nearest;
}

/// How much each tap counts, exactly.
std::array<Rational, 4> weights_at(const LitScene& lit, const LinearQuery& query)
{
    const auto place = place_on_map(lit, query.pixel);
    const auto part = [](const Rational& x, int first) {
        const Rational beyond = x - Rational{0.5} - first;
        return beyond < 0 ? Rational{0} : beyond > 1 ? Rational{1} : beyond;
    };
    const Rational x = part(place[0], query.first.x);
    const Rational y = part(place[1], query.first.y);
    return {Rational{(1 - x) * (1 - y)}, Rational{x * (1 - y)}, Rational{(1 - x) * y},
            Rational{x * y}};
}

TEST(CriticalBiases, AreThoseOfRationalsBetweenFourTaps)
{
    for_each_case([&](const LitScene& lit) {
        std::mt19937 random{8};
        const auto light = lit.light_queries();
        const auto texels = lit.all_texels();
        const auto hits = light->first_hits(texels, HitDetail::bounded);
        std::vector<LinearQuery> queries;
        for (const std::size_t pixel : lit.scored_pixels()) {
            LinearQuery query{pixel, {}, {}};
            const auto place = place_on_map(lit, pixel);
            // Now and then the point is not between the four, as where its uv was rounded.
            query.first = {floor_of(place[0] - Rational{0.5}) + static_cast<int>(random() % 8 == 0),
                           floor_of(place[1] - Rational{0.5}) -
                               static_cast<int>(random() % 8 == 0)};
            for (ExactTap& tap : query.taps) {
                const std::size_t texel = random() % texels.size();
                tap = tap_of(texels[texel], hits[texel], random() % 2 == 0);
            }
            queries.push_back(query);
        }
        const auto biases = light->critical_biases(std::span{queries}, {});
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const auto weights = weights_at(lit, queries[i]);
            Rational depth = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                depth += weights[k] * tap_depth(lit, queries[i].taps[k]);
            }
            EXPECT_EQ(biases[i], expected_bias(lit, queries[i].pixel, depth, false))
                << "pixel " << queries[i].pixel;
        }
    });
}

TEST(FindBlockers, MeasuresTheGapThatRationalsGive)
{
    int blocked = 0;
    for_each_case([&](const LitScene& lit) {
        const auto pixels = lit.scored_pixels();
        const auto blockers = lit.light_queries()->find_blockers(pixels, scene::Cull::none);
        const auto nearest = nearest_blockers(lit.reference, lit.view, lit.receivers, pixels);
        const bool is_directional = lit.view.light.type == scene::LightType::directional;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            ASSERT_EQ(blockers[i].triangle, nearest[i]);
            if (nearest[i] == no_triangle) {
                continue;
            }
            ++blocked;
            const RationalVec point = lit.point(pixels[i]);
            const RationalVec step = is_directional ? RationalVec{-lit.view.light.direction}
                                                    : RationalVec{lit.view.light.position} - point;
            const RationalVec way =
                hit_of(point, step, lit.triangles.corners(nearest[i]))->t * step;
            // The gap is good to 2^-42 for the way and a few roundings: below 1e-12. Squares have
            // twice the relative error.
            const Rational gap{blockers[i].gap_m};
            EXPECT_LE(abs(gap * gap - dot(way, way)), 2e-12 * dot(way, way))
                << "pixel " << pixels[i];
            // ζ is a sum of terms below 16 m with a few roundings, and the way's error: 16·2^-42.
            const auto light_distance = [&](const RationalVec& x) {
                const auto& frustum = lit.view.first_map();
                return dot(RationalVec{frustum.forward}, x - RationalVec{frustum.origin});
            };
            EXPECT_LE(abs(Rational{blockers[i].receiver_light_distance_m} - light_distance(point)),
                      4e-12);
            EXPECT_LE(abs(Rational{blockers[i].light_distance_m} - light_distance(point + way)),
                      4e-12);
        }
    });
    EXPECT_GT(blocked, 300);
}

TEST(LightQueries, AnswersTheSameWithAnyNumberOfThreads)
{
    const LightCase light = light_cases().back();
    const LitScene lit{random_sheets(2, true), light.light, light.frustum, 37};
    auto texels = lit.all_texels();
    std::ranges::reverse(texels); // answers come in the order of the questions
    const auto pixels = lit.scored_pixels();
    const auto one = lit.light_queries(Cull::none, 1);
    const auto three = lit.light_queries(Cull::none, 3);
    const auto hits = one->first_hits(texels, HitDetail::placed);
    const auto same_hits = three->first_hits(texels, HitDetail::placed);
    std::vector<NearestQuery> biases;
    std::vector<SelfShadowingQuery> sheets;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        ASSERT_EQ(hits[i].triangle, same_hits[i].triangle);
        ASSERT_EQ(hits[i].depth, same_hits[i].depth);
        ASSERT_EQ(hits[i].light_distance_m, same_hits[i].light_distance_m);
        const std::size_t pixel = pixels[i % pixels.size()];
        biases.push_back({pixel, {texels[i], hits[i].triangle, 1}});
        sheets.push_back(
            {pixel, texels[i], hits[i].triangle == no_triangle ? 0 : hits[i].triangle});
    }
    EXPECT_EQ(one->critical_biases(std::span{biases}, {true}),
              three->critical_biases(std::span{biases}, {true}));
    EXPECT_EQ(one->are_self_shadowing(sheets), three->are_self_shadowing(sheets));
    EXPECT_EQ(one->occluded(pixels, {}), three->occluded(pixels, {}));
}

TEST(LightQueries, AnswersTheSameWithAnyInstructionSet)
{
    // Packets of all sizes: a CPU that traces fewer rays at a time sees their idle lanes.
    const LightCase light = light_cases().back();
    const LitScene lit{random_sheets(3, true), light.light, light.frustum, 37};
    const auto texels = lit.all_texels();
    const auto expected = lit.light_queries()->first_hits(texels, HitDetail::placed);
    for (const char* const isa : {"sse2", "sse4.2", "avx", "avx2"}) {
        const ReferenceScene reference{lit.triangles, {.embree_isa = isa}};
        const auto exact =
            make_light_queries(reference, lit.view, lit.receivers, lit.resolution, Cull::none);
        std::size_t first = 0;
        for (std::size_t count = 1; first + count <= texels.size(); first += count, ++count) {
            const auto hits =
                exact->first_hits(std::span{texels}.subspan(first, count), HitDetail::placed);
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_EQ(hits[i].triangle, expected[first + i].triangle) << isa << ", " << count;
                ASSERT_EQ(hits[i].depth, expected[first + i].depth) << isa << ", " << count;
            }
        }
    }
}

} // namespace
} // namespace gnomon::reference_rt::test
