#include "scene/light/facing.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace gnomon::scene {
namespace {

using Place = std::array<double, 3>;

TriangleScene one_triangle(const std::array<Place, 3>& corners)
{
    TriangleScene made;
    for (const Place& corner : corners) {
        made.vertices.push_back(Vec3f{Vec3d{corner[0], corner[1], corner[2]}});
    }
    made.triangles = {{0, 1, 2}};
    return made;
}

Light lamp_at(const Vec3d& position)
{
    return {.type = LightType::point, .position = position};
}

Light sun_along(const Vec3d& direction)
{
    return {.type = LightType::directional, .direction = direction};
}

constexpr std::array<Place, 3> on_ground{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}}; // seen from above

TEST(Facings, AreSeenFromTheLight)
{
    const TriangleScene ground = one_triangle(on_ground);
    EXPECT_EQ(facings(ground, lamp_at({5, 2, -7})), std::vector<int>{1});
    EXPECT_EQ(facings(ground, lamp_at({5, -2, -7})), std::vector<int>{-1});
    EXPECT_EQ(facings(ground, lamp_at({5, 0, -7})), std::vector<int>{0});
    EXPECT_EQ(facings(ground, sun_along({0.25, -1, 0})), std::vector<int>{1});
    EXPECT_EQ(facings(ground, sun_along({0.25, 1, 0})), std::vector<int>{-1});
    EXPECT_EQ(facings(ground, sun_along({3, 0, -1})), std::vector<int>{0});
}

TEST(Facings, TellTheNeighboursOfAPlaneApart)
{
    const double step = 0x1p-23; // in the last place of a float32 at 1.5
    const TriangleScene slope =
        one_triangle({{{0, 0, 0}, {0x1p20, 0x1p20, 0}, {0, 0x1p-20, 0x1p-20}}});
    const Vec3d in_plane{1, 1 + 0.5, 0.5};
    EXPECT_EQ(facings(slope, lamp_at(in_plane)), std::vector<int>{0});
    const int above = facings(slope, lamp_at(in_plane + Vec3d{0, step, 0})).front();
    const int below = facings(slope, lamp_at(in_plane - Vec3d{0, step, 0})).front();
    EXPECT_NE(above, 0);
    EXPECT_EQ(above, -below);
    EXPECT_EQ(facings(slope, lamp_at({1, 1e15, 0.5})).front(), above);
}

/// The sign in rational arithmetic.
int sign_of_rationals(const std::array<Place, 3>& t, const Place& light)
{
    using Number = boost::multiprecision::cpp_rational;
    const auto difference = [](const Place& a, const Place& b) {
        return std::array<Number, 3>{Number{a[0]} - Number{b[0]}, Number{a[1]} - Number{b[1]},
                                     Number{a[2]} - Number{b[2]}};
    };
    const auto u = difference(t[1], t[0]);
    const auto v = difference(t[2], t[0]);
    const auto g = difference(light, t[0]);
    const Number det = (u[1] * v[2] - u[2] * v[1]) * g[0] + (u[2] * v[0] - u[0] * v[2]) * g[1] +
                       (u[0] * v[1] - u[1] * v[0]) * g[2];
    return det.sign();
}

TEST(Facings, AreThoseOfRationalsWhereverPointsNearlyLieInAPlane)
{
    std::mt19937 random{26};
    std::uniform_int_distribution<int> step{-2, 2};
    std::uniform_int_distribution<int> exponent{-20, 20};
    int in_plane = 0;
    for (int i = 0; i < 4000; ++i) {
        const double scale = std::ldexp(1.0, exponent(random));
        const auto near = [&](double x, double y) {
            // z = x + 2y, up to one or two units in the last place.
            const auto z = static_cast<float>(x + 2 * y);
            const float nudged = z + static_cast<float>(step(random)) * 0x1p-22F;
            return Place{scale * x, scale * y, scale * double{nudged}};
        };
        const std::array<Place, 3> corners{near(0.5, 0.25), near(1.75, 0.5), near(0.75, 1.25)};
        const Place light = near(1.125, 1.5);
        const int expected = sign_of_rationals(corners, light);
        in_plane += expected == 0 ? 1 : 0;
        ASSERT_EQ(facings(one_triangle(corners), lamp_at({light[0], light[1], light[2]})).front(),
                  expected)
            << fmt::format("try {}, scale {}", i, scale);
    }
    EXPECT_GT(in_plane, 20);
}

} // namespace
} // namespace gnomon::scene
