#include "reference_rt/certificate/rational_geometry.hpp"

#include "exact_oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gnomon::reference_rt::certificate {
namespace {

using scene::Light;
using scene::LightType;
using scene::Vec3d;
using scene::Vec3f;

Point at(double x, double y, double z)
{
    return Point{Vector{Vec3d{x, y, z}}};
}
Point towards(double x, double y, double z)
{
    return Point{Vector{Vec3d{x, y, z}}, Rational{}};
}
Triangle triangle(const Vec3d& u, const Vec3d& v, const Vec3d& w)
{
    return {Vector{u}, Vector{v}, Vector{w}};
}
bool equal(const Rational& a, const Rational& b)
{
    return (a - b).sign() == 0;
}
ContactKind kind(const Point& p, const Point& light, const Triangle& s)
{
    return contact_kind(contact_signs(p, light, s));
}

/// In the plane z = 1, around (1, 0, 1).
const Triangle roof = triangle({0, -1, 1}, {2, -1, 1}, {1, 2, 1});

TEST(Rational, KeepsEveryDouble)
{
    const double largest = std::numeric_limits<double>::max();
    const double smallest = std::numeric_limits<double>::denorm_min();
    for (const double value :
         {0.0, 1.0, -1.0, 0.1, -0.1, 3e15, -0x1.fffffffffffffp+0, largest, -largest, smallest}) {
        EXPECT_EQ(Rational{value}.rounded(), value);
        EXPECT_EQ(Rational{value}.sign(), (value > 0) - (value < 0)) << value;
    }
}

TEST(Rational, NeverRounds)
{
    const Rational tiny{std::numeric_limits<double>::denorm_min()};
    const Rational huge{std::numeric_limits<double>::max()};
    EXPECT_TRUE(equal((huge + tiny) - huge, tiny));
    EXPECT_TRUE(equal((huge + tiny) * (huge - tiny), huge * huge - tiny * tiny));
    EXPECT_EQ((huge * tiny - tiny * huge).sign(), 0);
    EXPECT_EQ((huge + tiny - huge - tiny - tiny).sign(), -1);
}

TEST(Rational, ObeysTheRingsLaws)
{
    std::mt19937_64 random{20240601};
    const auto draw = [&] {
        const double mantissa = std::uniform_real_distribution{-1.0, 1.0}(random);
        return std::ldexp(mantissa, std::uniform_int_distribution{-300, 300}(random));
    };
    for (int i = 0; i < 2000; ++i) {
        const double a = draw();
        const double b = draw();
        const double c = draw();
        const Rational x{a};
        const Rational y{b};
        const Rational z{c};
        ASSERT_TRUE(equal((x + y) * z, x * z + y * z)) << a << ' ' << b << ' ' << c;
        ASSERT_TRUE(equal((x + y) * (x - y), x * x - y * y)) << a << ' ' << b;
        ASSERT_TRUE(equal(x - (y - z), (x - y) + z)) << a << ' ' << b << ' ' << c;
        ASSERT_EQ((x - y).sign(), (a > b) - (a < b)) << a << ' ' << b;
    }
}

TEST(Fraction, ComparesExactly)
{
    const Fraction third{Rational{1.0}, Rational{3.0}};
    const Fraction rounded_third{Rational{1.0 / 3.0}};
    EXPECT_EQ(compare(third, {Rational{2.0}, Rational{6.0}}), 0);
    EXPECT_NE(compare(third, rounded_third), 0);
    EXPECT_EQ(compare({Rational{-1.0}, Rational{3.0}}, third), -1);
}

TEST(ContactKind, SeesACrossingBetweenPAndTheLight)
{
    EXPECT_EQ(kind(at(0, 0, 0), at(2, 0, 2), roof), ContactKind::crossing);
    EXPECT_EQ(kind(at(0, 0, 0), towards(1, 0, 1), roof), ContactKind::crossing);
    EXPECT_EQ(kind(at(2, 0, 2), at(0, 0, 0), roof), ContactKind::crossing);
}

TEST(ContactKind, SeesNothingBesideBehindOrBeyond)
{
    EXPECT_EQ(kind(at(0, 0, 0), at(6, 0, 2), roof), ContactKind::none);
    EXPECT_EQ(kind(at(0, 0, 0), at(0.5, 0, 0.5), roof), ContactKind::none);
    EXPECT_EQ(kind(at(2, 0, 2), at(3, 0, 3), roof), ContactKind::none);
    EXPECT_EQ(kind(at(0, 0, 0), towards(-1, 0, -1), roof), ContactKind::none);
}

TEST(ContactKind, IgnoresWhatIsMetAtPOrAtTheLightOnly)
{
    EXPECT_EQ(kind(at(1, 0, 1), at(2, 0, 2), roof), ContactKind::none);
    EXPECT_EQ(kind(at(0, 0, 0), at(1, 0, 1), roof), ContactKind::none);
    EXPECT_EQ(kind(at(1, 0, 1), towards(0, 0, 1), roof), ContactKind::none);
}

TEST(ContactKind, SeesEdgesAndCorners)
{
    EXPECT_EQ(kind(at(0, 0, 0), at(2, -2, 2), roof), ContactKind::through_edge);
    EXPECT_EQ(kind(at(0, 0, 0), towards(1, -1, 1), roof), ContactKind::through_edge);
    EXPECT_EQ(kind(at(0, 0, 0), at(2, 4, 2), roof), ContactKind::through_corner);
    EXPECT_EQ(kind(at(0, 0, 0), towards(0, -1, 1), roof), ContactKind::through_corner);
}

TEST(ContactKind, TellsTheLastBit)
{
    const double above = std::nextafter(-2.0, 0.0);
    const double below = std::nextafter(-2.0, -3.0);
    EXPECT_EQ(kind(at(0, 0, 0), at(2, above, 2), roof), ContactKind::crossing);
    EXPECT_EQ(kind(at(0, 0, 0), at(2, below, 2), roof), ContactKind::none);
}

TEST(ContactKind, AgreesWithBarycentricCoordinatesOnALattice)
{
    // Small integers meet edges and corners often.
    std::mt19937_64 random{7};
    const auto draw = [&] {
        return static_cast<float>(std::uniform_int_distribution{-2, 2}(random));
    };
    const auto point = [&] {
        const float x = draw();
        const float y = draw();
        return Vec3f{x, y, draw()};
    };
    std::array<int, 5> seen{};
    for (int i = 0; i < 20'000; ++i) {
        const Vec3f p = point();
        Light light;
        light.type = i % 2 == 0 ? LightType::spot : LightType::directional;
        light.position = Vec3d{point()};
        light.direction = light.position;
        const std::array<Vec3f, 3> s{point(), point(), point()};
        const Vec3d normal =
            glm::cross(Vec3d{s[1]} - Vec3d{s[0]}, Vec3d{s[2]} - Vec3d{s[0]}); // exact
        const bool has_no_segment = light.type == LightType::spot ? light.position == Vec3d{p}
                                                                  : light.direction == Vec3d{0};
        if (normal == Vec3d{0} || has_no_segment) {
            continue;
        }
        const ContactKind found =
            kind(Point{Vector{Vec3d{p}}}, light_point(light), exact_triangle(s));
        const auto expected = test::exact_contact(test::RationalVec{Vec3d{p}}, light, s);
        const bool is_boundary =
            found == ContactKind::through_edge || found == ContactKind::through_corner;
        ASSERT_EQ(expected == test::ExactContact::cross, found == ContactKind::crossing) << i;
        ASSERT_EQ(expected == test::ExactContact::boundary, is_boundary) << i;
        ++seen[static_cast<std::size_t>(found)];
    }
    for (const int count : seen) {
        EXPECT_GT(count, 100); // every kind was tried
    }
}

TEST(MeetsInPlane, TellsWhetherTheSegmentReachesTheTriangle)
{
    // Everything is in the plane y = 0; the segment is on z = x.
    const Triangle across = triangle({1, 0, 0.5}, {1, 0, 2}, {2, 0, 1});
    EXPECT_EQ(kind(at(0, 0, 0), at(4, 0, 4), across), ContactKind::in_plane);
    EXPECT_TRUE(meets_in_plane(at(0, 0, 0), at(4, 0, 4), across));
    EXPECT_TRUE(meets_in_plane(at(0, 0, 0), towards(1, 0, 1), across));
    EXPECT_TRUE(meets_in_plane(at(1.25, 0, 1.25), at(1.26, 0, 1.26), across)); // inside
    EXPECT_FALSE(meets_in_plane(at(0, 0, 0), at(0.5, 0, 0.5), across));        // ends before
    EXPECT_FALSE(meets_in_plane(at(2, 0, 2), towards(1, 0, 1), across));       // begins after
    const Triangle beside = triangle({3, 0, 0.5}, {4, 0, 0.5}, {4, 0, 1});
    EXPECT_FALSE(meets_in_plane(at(0, 0, 0), towards(1, 0, 1), beside));
}

TEST(MeetsInPlane, CountsTheBoundaryButNotTheEndsOfTheSegment)
{
    const Triangle corner_on_line = triangle({1, 0, 1}, {2, 0, 1}, {2, 0, 0});
    EXPECT_TRUE(meets_in_plane(at(0, 0, 0), towards(1, 0, 1), corner_on_line));
    EXPECT_FALSE(meets_in_plane(at(1, 0, 1), towards(1, 0, 1), corner_on_line)); // at P
    EXPECT_FALSE(meets_in_plane(at(0, 0, 0), at(1, 0, 1), corner_on_line));      // at the light
    const Triangle edge_on_line = triangle({1, 0, 1}, {2, 0, 2}, {2, 0, 0});
    EXPECT_TRUE(meets_in_plane(at(0, 0, 0), towards(1, 0, 1), edge_on_line));
    EXPECT_TRUE(meets_in_plane(at(1, 0, 1), towards(1, 0, 1), edge_on_line));
}

TEST(HitParameter, TakesClosedTrianglesAndTheirPlanesOnly)
{
    const auto ray = [](double x, double y) {
        return CameraRay{{Vec3d{x, y, 4}, Vec3d{0, 0, -2}}};
    };
    const auto inside = hit_parameter(ray(1, 0), roof);
    ASSERT_TRUE(inside);
    EXPECT_EQ(compare(*inside, {Rational{3.0}, Rational{2.0}}), 0);
    EXPECT_TRUE(hit_parameter(ray(1, -1), roof));
    EXPECT_TRUE(hit_parameter(ray(1, 2), roof));
    EXPECT_FALSE(hit_parameter(ray(1, std::nextafter(-1.0, -2.0)), roof));
    const Triangle edge_on = triangle({1, -1, 0}, {1, 1, 0}, {1, 0, 2});
    EXPECT_FALSE(hit_parameter(ray(1, 0), edge_on));
}

TEST(PointAt, IsAsExactAsItsTriangle)
{
    // No double holds a third: P is on the plane all the same.
    const CameraRay ray{{Vec3d{0, 0, 1}, Vec3d{0, 0, -3}}};
    const Triangle ground = triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    const Point p = point_at(ray, *plane_parameter(ray, ground));
    EXPECT_EQ(orientation(ground[0], ground[1], Point{ground[2]}, p), 0);
    EXPECT_GT(p.weight.sign(), 0);
    const Triangle turned{ground[1], ground[0], ground[2]};
    EXPECT_GT(point_at(ray, *plane_parameter(ray, turned)).weight.sign(), 0);
}

TEST(FacesAway, HoldsBehindAndExactlyInThePlane)
{
    const CameraRay ray{{Vec3d{1, 0, 4}, Vec3d{0, 0, -1}}};
    const double below_one = std::nextafter(1.0, 0.0);
    EXPECT_FALSE(faces_away(ray, at(0, 0, std::nextafter(1.0, 2.0)), roof));
    EXPECT_TRUE(faces_away(ray, at(0, 0, 1), roof));
    EXPECT_TRUE(faces_away(ray, at(0, 0, below_one), roof));
    EXPECT_FALSE(faces_away(ray, towards(1, 0, 1e-30), roof));
    EXPECT_TRUE(faces_away(ray, towards(1, 0, 0), roof));
    const Triangle turned{roof[1], roof[0], roof[2]};
    EXPECT_FALSE(faces_away(ray, at(0, 0, 2), turned));
    EXPECT_TRUE(faces_away(ray, at(0, 0, 1), turned));
}

TEST(IsInCone, KeepsTheBoundaryAndRejectsTheNextCosine)
{
    // (1, 1, 0) and (1, 0, 1) are 60° apart, and cos 60° is a double.
    Light spot;
    spot.type = LightType::spot;
    spot.position = {1e6, 0, 0};
    spot.direction = {1, 1, 0};
    spot.cos_half_cone = 0.5;
    const Point p = at(1e6 + 1, 0, 1);
    EXPECT_TRUE(is_in_cone(p, spot));
    spot.cos_half_cone = std::nextafter(0.5, 1.0);
    EXPECT_FALSE(is_in_cone(p, spot));
    spot.cos_half_cone = std::nextafter(0.5, 0.0);
    EXPECT_TRUE(is_in_cone(p, spot));
}

TEST(IsInCone, RejectsWhatIsBehindTheLight)
{
    Light spot;
    spot.type = LightType::spot;
    spot.position = {0, 0, 0};
    spot.direction = {0, 0, -1};
    spot.cos_half_cone = 0.1;
    EXPECT_TRUE(is_in_cone(at(0, 0, -1), spot));
    EXPECT_FALSE(is_in_cone(at(0, 0, 1), spot));
    EXPECT_FALSE(is_in_cone(at(1, 0, 0), spot));
}

} // namespace
} // namespace gnomon::reference_rt::certificate
