// Receivers moved by bias terms, and taps shifted by an offset; their numbers are taken as exact.

#include "light_fixture.hpp"
#include "reference_rt/light/texel_rays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gnomon::reference_rt::test {
namespace {

using Moves = Image<scene::Vec4f>;

/// Every third pixel stays where it is; others move by up to a quarter metre and of the depth
/// range.
Moves random_moves(const LitScene& lit, std::mt19937& random)
{
    std::uniform_real_distribution<float> part{-0.25F, 0.25F};
    Moves moves{lit.receivers.size()};
    for (std::size_t i = 0; i < moves.pixel_count(); ++i) {
        if (i % 3 != 0) {
            moves[i] = {part(random), part(random), part(random), i % 3 == 1 ? part(random) : 0};
        }
    }
    return moves;
}

RationalVec moved_point(const LitScene& lit, const Moves& moves, std::size_t pixel)
{
    return lit.point(pixel) + RationalVec{scene::Vec3d{moves[pixel]}};
}

Rational moved_depth(const LitScene& lit, const Moves& moves, std::size_t pixel)
{
    const Rational depth = *matrix_depth(lit.view.first_map(), moved_point(lit, moves, pixel));
    const Rational nearer{double{moves[pixel].w}};
    return lit.view.first_map().reversed ? Rational{depth + nearer} : Rational{depth - nearer};
}

TEST(MovedReceivers, HaveTheCriticalBiasesOfRationals)
{
    for_each_case([](const LitScene& lit) {
        std::mt19937 random{11};
        const Moves moves = random_moves(lit, random);
        std::uniform_real_distribution<double> shift{-0.125, 0.125};
        const auto light = lit.light_queries();
        const auto texels = lit.all_texels();
        const auto hits = light->first_hits(texels, HitDetail::bounded);
        std::vector<NearestQuery> queries;
        for (const std::size_t pixel : lit.scored_pixels()) {
            const std::size_t texel = random() % texels.size();
            const TexelHit& hit = hits[texel];
            queries.push_back({pixel, {texels[texel], hit.triangle, hit.depth, hit.depth_error}});
            queries.back().tap.shift = random() % 2 == 0 ? shift(random) : 0;
        }
        for (const bool clamps : {false, true}) {
            const auto biases = light->critical_biases(std::span{queries}, {clamps, &moves});
            for (std::size_t i = 0; i < queries.size(); ++i) {
                Rational r = moved_depth(lit, moves, queries[i].pixel);
                r = clamps ? (r < 0 ? Rational{0} : r > 1 ? Rational{1} : r) : r;
                const Rational d = tap_depth(lit, queries[i].tap) + Rational{queries[i].tap.shift};
                EXPECT_EQ(biases[i], smallest_bias(lit.view.first_map().reversed ? Rational{d - r}
                                                                                 : Rational{r - d}))
                    << "pixel " << queries[i].pixel;
            }
        }
    });
}

TEST(MovedReceivers, HaveTheDepthsOfRationalsRoundedOnce)
{
    for_each_case([](const LitScene& lit) {
        std::mt19937 random{12};
        const Moves moves = random_moves(lit, random);
        const auto pixels = lit.scored_pixels();
        const auto depths = lit.light_queries()->receiver_depths(pixels, {}, &moves);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const Rational depth = moved_depth(lit, moves, pixels[i]);
            const auto off = [&](float x) {
                return Rational{abs(Rational{static_cast<double>(x)} - depth)};
            };
            EXPECT_LE(off(depths[i]), off(std::nextafter(depths[i], 9.0F))) << pixels[i];
            EXPECT_LE(off(depths[i]), off(std::nextafter(depths[i], -9.0F))) << pixels[i];
        }
    });
}

/// uv · n of a point.
std::array<Rational, 2> place_of(const LitScene& lit, const RationalVec& point)
{
    const ClipRows rows{lit.view.first_map()};
    const auto at = [&](const scene::Vec4d& row) {
        return Rational{dot(RationalVec{scene::Vec3d{row}}, point) + Rational{row.w}};
    };
    const auto along = [&](const scene::Vec4d& axis) {
        return Rational{lit.resolution * (at(axis) / at(rows.w) + 1) / 2};
    };
    return {along(rows.x), along(rows.y)};
}

/// The scene's ground lies on a lattice, as the texels of the aligned lights do: many places are
/// exactly on a texel's border.
TEST(MapPlaces, AreThoseOfRationalsRoundedDown)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for_each_case([](const LitScene& lit) {
        std::mt19937 random{13};
        const Moves moves = random_moves(lit, random);
        const auto pixels = lit.scored_pixels();
        const auto light = lit.light_queries();
        for (const Moves* moved : {static_cast<const Moves*>(nullptr), &moves}) {
            const auto places = light->map_places(pixels, {}, moved);
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                const auto exact =
                    place_of(lit, moved == nullptr ? lit.point(pixels[i])
                                                   : moved_point(lit, moves, pixels[i]));
                for (const std::size_t axis : {0U, 1U}) {
                    const float place = places[i][static_cast<int>(axis)];
                    EXPECT_LE(Rational{static_cast<double>(place)}, exact.at(axis)) << pixels[i];
                    EXPECT_GT(Rational{static_cast<double>(std::nextafter(place, infinity))},
                              exact.at(axis))
                        << pixels[i];
                }
            }
        }
    });
}

TEST(MapPlaces, GrowUncertainWithTheDistanceFromTheOrigin)
{
    const auto error_at = [](double shift_m) {
        scene::SceneBuilder builder;
        builder.add("floor",
                    std::vector<Vec3d>{{shift_m, 0, 0}, {shift_m + 4, 0, 0}, {shift_m, 0, 4}},
                    std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}});
        return LitScene{builder.take(), directional({0, -1, 0.25}), {}}
            .light_queries()
            ->place_error_texels();
    };
    // 16 texels for 4 m: 256 · 2⁻²⁴ · 4 · 10⁶ = 61 texels at 10⁶ m, and nothing much near the
    // origin.
    EXPECT_LT(error_at(0), 0.01);
    EXPECT_GT(error_at(1e6), 30);
}

} // namespace
} // namespace gnomon::reference_rt::test
