// Distances to the light: bounded, in twice double's precision, and by roots of exact squares.

#include "reference_rt/light/float_rounding.hpp"
#include "reference_rt/light/light_distance.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace gnomon::reference_rt {
namespace {

using Many = boost::multiprecision::cpp_bin_float_100;

Fraction quotient(double numerator, double denominator)
{
    return {Dyadic{numerator}, Dyadic{denominator}};
}

TEST(ARoot, IsComparedExactly)
{
    const Root root{quotient(9, 4)};
    EXPECT_EQ(root.value(), 1.5);
    EXPECT_EQ(root.sign_beyond(1.5), 0);
    EXPECT_EQ(root.sign_beyond(std::nextafter(1.5, 2)), -1);
    EXPECT_EQ(root.sign_beyond(std::nextafter(1.5, 1)), 1);
    EXPECT_EQ(root.sign_beyond(-1.5), 1);
    EXPECT_EQ((Root{quotient(0, 1)}.sign_beyond(0)), 0);
}

TEST(ADifferenceOfRoots, IsComparedExactly)
{
    const RootDifference two{quotient(9, 1), quotient(1, 1)};
    EXPECT_EQ(two.sign_beyond(2), 0);
    EXPECT_EQ(two.sign_beyond(std::nextafter(2, 3)), -1);
    EXPECT_EQ(two.sign_beyond(std::nextafter(2, 1)), 1);
    EXPECT_EQ(two.sign_beyond(-2), 1);
    EXPECT_EQ(two.sign_beyond(0), 1);
    const RootDifference minus_two{two.b, two.a};
    EXPECT_EQ(minus_two.sign_beyond(-2), 0);
    EXPECT_EQ(minus_two.sign_beyond(std::nextafter(-2, 0)), -1);
    EXPECT_EQ(minus_two.sign_beyond(2), -1);
    const RootDifference none{quotient(7, 3), quotient(14, 6)};
    EXPECT_EQ(none.sign(), 0);
    EXPECT_EQ(none.sign_beyond(0), 0);
    EXPECT_EQ(none.sign_beyond(1e-300), -1);
    EXPECT_EQ((RootDifference{quotient(0, 1), quotient(0, 1)}.sign_beyond(0)), 0);
    EXPECT_EQ((RootDifference{quotient(0, 1), quotient(1, 4)}.sign_beyond(-0.5)), 0);
    EXPECT_EQ((RootDifference{quotient(1, 4), quotient(0, 1)}.sign_beyond(0.5)), 0);
}

/// Against a hundred digits, near the difference itself.
TEST(ADifferenceOfRoots, IsThatOfManyDigits)
{
    std::mt19937 random{31};
    std::uniform_real_distribution<double> number{0, 1};
    for (int i = 0; i < 20'000; ++i) {
        const double a = number(random);
        const double b = i % 3 == 0 ? a * (1 + 1e-12 * number(random)) : number(random);
        const double c = number(random);
        const RootDifference roots{quotient(a, c), quotient(b, c)};
        const Many exact = sqrt(Many{a} / Many{c}) - sqrt(Many{b} / Many{c});
        const double rounded = exact.convert_to<double>();
        EXPECT_NEAR(roots.value(), rounded, RootDifference::relative_error * std::abs(rounded));
        for (const double bound :
             {rounded, std::nextafter(rounded, 9), std::nextafter(rounded, -9), 0.0}) {
            const Many beyond = exact - Many{bound};
            ASSERT_EQ(roots.sign_beyond(bound), beyond.sign())
                << "a " << a << " b " << b << " c " << c << " bound " << bound;
        }
        EXPECT_EQ(exactly_rounded<ToNearest>(roots), static_cast<float>(exact));
    }
}

/// Rays and triangles about a light, and what many digits say.
TEST(ALightDistance, IsThatOfManyDigits)
{
    std::mt19937 random{32};
    std::uniform_real_distribution<float> metres{-4, 4};
    const auto point = [&] {
        return scene::Vec3d{scene::Vec3f{metres(random), metres(random), metres(random)}};
    };
    scene::LightFrustum frustum;
    frustum.projection = scene::Projection::perspective;
    frustum.content = scene::MapContent::distance;
    frustum.origin = scene::Vec3d{scene::Vec3f{0.3F, -1.7F, 2.1F}};
    frustum.far_m = 12.7; // no float32: what is divided by is
    const Many far_m{static_cast<float>(frustum.far_m)};
    const LightDistance distance{frustum};
    int decided = 0;
    for (int i = 0; i < 5'000; ++i) {
        const ExactTriangle face{{0, {point(), point(), point()}}};
        // From elsewhere, as receivers are seen, and from the light, as texels are.
        const CameraRay ray{{i % 2 == 0 ? point() : frustum.origin, point()}};
        SignCounts counts;
        const Receiver hit{face, ray, counts};
        if (hit.delta_sign == 0) {
            continue;
        }
        using Vector = std::array<Many, 3>;
        const auto many = [](const scene::Vec3d& v) { return Vector{v.x, v.y, v.z}; };
        const auto minus = [](const Vector& a, const Vector& b) {
            return Vector{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        };
        const auto dot_of = [](const Vector& a, const Vector& b) -> Many {
            return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        };
        const Vector u = minus(many(face.corners[1]), many(face.corners[0]));
        const Vector v = minus(many(face.corners[2]), many(face.corners[0]));
        const Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0]};
        const Vector origin = many(ray.ray.origin);
        const Vector direction = many(ray.ray.direction);
        const Many t = dot_of(n, minus(many(face.corners[0]), origin)) / dot_of(n, direction);
        Vector from_light = minus(origin, many(frustum.origin));
        for (std::size_t k = 0; k < 3; ++k) {
            from_light[k] += t * direction[k];
        }
        const Many exact = sqrt(dot_of(from_light, from_light)) / far_m;
        const auto within = [&](double value, double error) {
            return abs(Many{value} - exact) <= Many{error};
        };
        const Interval bounded = distance.at(hit);
        EXPECT_TRUE(within(bounded.value, bounded.error)) << i;
        const DoubleDouble wide = distance.at_double_double(hit);
        EXPECT_TRUE(abs(Many{wide.high} + Many{wide.low} - exact) <= Many{wide.error}) << i;
        EXPECT_LT(wide.error, 1e-20 * wide.high) << i;
        decided += bounded.error < 1e-12 ? 1 : 0;
        EXPECT_EQ(exactly_rounded<ToNearest>(Root{distance.exactly_at(hit).number}),
                  static_cast<float>(exact))
            << i;
        const Interval place = distance.place(hit);
        EXPECT_LE(place.error, 0x1p-48);
        EXPECT_TRUE(exact > 1 ? place.value == 1 : within(place.value, place.error)) << i;
    }
    EXPECT_GT(decided, 4'500);
}

/// W·(P, 1) − near over far − near, with near and far as float32s.
TEST(LinearDepth, IsThatOfManyDigits)
{
    std::mt19937 random{33};
    std::uniform_real_distribution<float> metres{-4, 4};
    const auto point = [&] {
        return scene::Vec3d{scene::Vec3f{metres(random), metres(random), metres(random)}};
    };
    scene::LightFrustum frustum;
    frustum.projection = scene::Projection::perspective;
    frustum.content = scene::MapContent::linear;
    frustum.near_m = 0.3; // no float32s: what is subtracted and divided by is
    frustum.far_m = 12.7;
    const scene::Vec4f axis{0.48F, -0.6F, 0.64F, 1.7F};
    for (int column = 0; column < 4; ++column) {
        frustum.light_clip_from_world[column][3] = axis[column];
    }
    const Many near_m{static_cast<float>(frustum.near_m)};
    const Many far_m{static_cast<float>(frustum.far_m)};
    const LightDistance linear{frustum};
    int decided = 0;
    int in_range = 0;
    for (int i = 0; i < 5'000; ++i) {
        const ExactTriangle face{{0, {point(), point(), point()}}};
        const CameraRay ray{{point(), point()}};
        SignCounts counts;
        const Receiver hit{face, ray, counts};
        if (hit.delta_sign == 0) {
            continue;
        }
        // The plane's normal, by cofactors.
        const auto u = face.corners[1] - face.corners[0];
        const auto v = face.corners[2] - face.corners[0];
        const auto cross = [](const scene::Vec3d& a, const scene::Vec3d& b, int x, int y) -> Many {
            return Many{a[x]} * Many{b[y]} - Many{a[y]} * Many{b[x]};
        };
        const std::array<Many, 3> n{cross(u, v, 1, 2), cross(u, v, 2, 0), cross(u, v, 0, 1)};
        Many nu = 0;
        Many delta = 0;
        for (int k = 0; k < 3; ++k) {
            const auto axis_k = static_cast<std::size_t>(k);
            nu += n.at(axis_k) * (Many{face.corners[0][k]} - Many{ray.ray.origin[k]});
            delta += n.at(axis_k) * Many{ray.ray.direction[k]};
        }
        const Many t = nu / delta;
        Many exact = Many{axis.w} - near_m;
        for (int k = 0; k < 3; ++k) {
            exact += Many{axis[k]} * (Many{ray.ray.origin[k]} + t * Many{ray.ray.direction[k]});
        }
        exact /= far_m - near_m;
        const auto within = [&](double value, double error) {
            return abs(Many{value} - exact) <= Many{error};
        };
        const Interval bounded = linear.at(hit);
        EXPECT_TRUE(within(bounded.value, bounded.error)) << i;
        const DoubleDouble wide = linear.at_double_double(hit);
        EXPECT_TRUE(abs(Many{wide.high} + Many{wide.low} - exact) <= Many{wide.error}) << i;
        const ExactDepth depth = linear.exactly_at(hit);
        EXPECT_FALSE(depth.is_square);
        EXPECT_EQ(exactly_rounded<ToNearest>(depth.number), static_cast<float>(exact)) << i;
        const Interval place = linear.place(hit);
        EXPECT_LE(place.error, 0x1p-48);
        const bool is_inside = exact >= 0 && exact <= 1;
        in_range += is_inside ? 1 : 0;
        EXPECT_TRUE(is_inside ? within(place.value, place.error)
                              : place.value == (exact > 1 ? 1 : 0))
            << i;
        decided += bounded.error < 1e-12 ? 1 : 0;
    }
    EXPECT_GT(decided, 4'000);
    EXPECT_GT(in_range, 500);
}

} // namespace
} // namespace gnomon::reference_rt
