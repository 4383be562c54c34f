#include "lane.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/exact/triangle_contact.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <random>
#include <sstream>

/// Every sign against GMP's rationals, which evaluate the definitions with the point P itself.
namespace gnomon::reference_rt {
namespace {

using scene::Light;
using scene::LightType;
using scene::Ray;
using scene::Vec3d;

struct Rational3 {
    mpq_class x, y, z;

    Rational3(mpq_class x_in, mpq_class y_in, mpq_class z_in)
        : x{std::move(x_in)},
          y{std::move(y_in)},
          z{std::move(z_in)}
    {
    }
    explicit Rational3(const Vec3d& v) : x{v.x}, y{v.y}, z{v.z} {}

    friend Rational3 operator-(const Rational3& a, const Rational3& b)
    {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
};

mpq_class dot(const Rational3& a, const Rational3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Rational3 cross(const Rational3& a, const Rational3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Side of x from the plane through o that the two directions span.
Sign side(const Rational3& o, const Rational3& first, const Rational3& second, const Rational3& x)
{
    return sgn(dot(cross(first, second), x - o));
}

/// One pixel, two triangles, one light.
struct Question {
    Ray ray;
    Corners t;
    Corners s;
    Light light;
};

std::string text(const Question& question)
{
    std::ostringstream out;
    out << std::hexfloat;
    const auto put = [&](const char* name, const Vec3d& v) {
        out << name << " = {" << v.x << ", " << v.y << ", " << v.z << "}; ";
    };
    put("E", question.ray.origin);
    put("d", question.ray.direction);
    for (const auto* corners : {&question.t, &question.s}) {
        for (const Vec3d& corner : *corners) {
            put(corners == &question.t ? "t" : "s", corner);
        }
    }
    put(question.light.type == LightType::spot ? "L" : "no L", question.light.position);
    put("l", question.light.direction);
    return out.str();
}

/// Questions about random triangles, and about ones that touch the segment to within a rounding or
/// exactly.
class Questions {
public:
    explicit Questions(unsigned seed) : random_{seed} {}

    Question next()
    {
        const int kind = integer(0, 3);
        Question question = kind == 0 ? lattice() : anywhere();
        if (kind >= 2) {
            move_towards_segment(question, kind == 3);
        }
        return question;
    }

private:
    int integer(int lower, int upper)
    {
        return std::uniform_int_distribution<int>{lower, upper}(random_);
    }
    double real() { return std::uniform_real_distribution<double>{-1, 1}(random_); }
    Vec3d rounded(const Vec3d& v) { return Vec3d{scene::Vec3f{v}}; }
    Vec3d point(double size, const Vec3d& shift)
    {
        return rounded(shift + size * Vec3d{real(), real(), real()});
    }
    Vec3d lattice_point() { return Vec3d{integer(-3, 3), integer(-3, 3), integer(-3, 3)}; }

    Light light(bool has_directional, const Vec3d& direction, const Vec3d& position)
    {
        Light light;
        light.type = has_directional ? LightType::directional : LightType::spot;
        light.direction = direction == Vec3d{0} ? Vec3d{0, -1, 0} : direction;
        light.position = position;
        light.cos_half_cone = 0.25 * (3 + real());
        return light;
    }

    /// Small integers: most signs have a fair chance of being exactly zero.
    Question lattice()
    {
        Question question;
        question.ray = {lattice_point(), lattice_point()};
        question.t = {lattice_point(), lattice_point(), lattice_point()};
        question.s = {lattice_point(), lattice_point(), lattice_point()};
        question.light = light(integer(0, 1) == 0, lattice_point(), lattice_point());
        return question;
    }

    Question anywhere()
    {
        const double size = std::ldexp(1.0, integer(-12, 12));
        const Vec3d shift = integer(0, 1) == 0 ? Vec3d{0} : point(1000 * size, Vec3d{0});
        Question question;
        question.t = {point(size, shift), point(size, shift), point(size, shift)};
        question.s = {point(size, shift), point(size, shift), point(size, shift)};
        // An orthographic camera's origins and every direction have all of a double's digits.
        question.ray.origin = shift + 3 * size * Vec3d{real(), real(), real()};
        question.ray.direction =
            (question.t[0] + question.t[1] + question.t[2]) / 3.0 - question.ray.origin;
        question.light =
            light(integer(0, 1) == 0, rounded({real(), real(), real()}), point(4 * size, shift));
        return question;
    }

    /// Puts corners of S within a rounding of the segment, or of the plane of T.
    void move_towards_segment(Question& question, bool whole_triangle)
    {
        SignCounts counts;
        const ExactTriangle face{{0, question.t}};
        const CameraRay ray{question.ray};
        const Receiver receiver{face, ray, counts};
        if (receiver.delta_sign == 0) {
            return;
        }
        const Vec3d p = receiver.point();
        const Vec3d step = question.light.type == LightType::directional
                               ? -question.light.direction
                               : question.light.position - p;
        question.s[0] = rounded(p + 0.5 * (1 + real()) * step);
        if (whole_triangle) {
            question.s[1] = integer(0, 1) == 0 ? question.t[1] : rounded(p + real() * step);
            question.s[2] = integer(0, 2) == 0 ? question.t[2] : question.s[2];
        }
    }

    std::mt19937 random_;
};

/// Checks every sign of one question; returns how many.
int check(const Question& question, SignCounts& counts)
{
    const auto& [ray, t, s, light] = question;
    const ExactTriangle face{{0, t}};
    const CameraRay camera_ray{ray};
    const Receiver receiver{face, camera_ray, counts};
    const Rational3 a{t[0]};
    const Rational3 normal = cross(Rational3{t[1]} - a, Rational3{t[2]} - a);
    const mpq_class delta = dot(normal, Rational3{ray.direction});
    EXPECT_EQ(receiver.delta_sign, sgn(delta));
    if (delta == 0) {
        return 1;
    }
    const mpq_class r = dot(normal, a - Rational3{ray.origin}) / delta;
    const Rational3 p{ray.origin.x + r * ray.direction.x, ray.origin.y + r * ray.direction.y,
                      ray.origin.z + r * ray.direction.z};
    const bool is_directional = light.type == LightType::directional;
    const auto towards = [&](const Rational3& x) {
        return is_directional ? Rational3{-light.direction} : Rational3{light.position} - x;
    };
    const std::array<Rational3, 3> c{Rational3{s[0]}, Rational3{s[1]}, Rational3{s[2]}};
    const ShadowSigns signs = shadow_signs(receiver, s, light, counts);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(signs.edge[i], side(c[i], c[(i + 1) % 3] - c[i], towards(c[i]), p)) << i;
    }
    const Rational3 m = cross(c[1] - c[0], c[2] - c[0]);
    EXPECT_EQ(signs.point, sgn(dot(m, p - c[0])));
    EXPECT_EQ(signs.light, sgn(dot(m, towards(c[0]))));
    EXPECT_EQ(apex_side(light, s[0], s[1], s[2], counts),
              side(c[0], c[1] - c[0], towards(c[0]), c[2]));
    const mpq_class seen = -dot(normal, Rational3{ray.direction});
    const Sign positional = sgn(dot(normal, towards(a)));
    EXPECT_EQ(is_attached(receiver, light_side(t, light, counts)),
              positional == 0 || positional != sgn(seen));
    EXPECT_EQ(is_beyond(receiver, 0.5, counts), r > mpq_class{0.5});
    EXPECT_EQ(is_coplanar(receiver, s, counts), dot(normal, c[0] - a) == 0 &&
                                                    dot(normal, c[1] - a) == 0 &&
                                                    dot(normal, c[2] - a) == 0);
    const ExactTriangle other_face{{1, s}};
    const Receiver other{other_face, camera_ray, counts};
    const mpq_class other_delta = dot(m, Rational3{ray.direction});
    if (other_delta != 0) {
        const mpq_class other_r = dot(m, c[0] - Rational3{ray.origin}) / other_delta;
        EXPECT_EQ(compare_distance(receiver, other, counts), cmp(r, other_r) < 0   ? -1
                                                             : cmp(r, other_r) > 0 ? 1
                                                                                   : 0);
    }
    if (!is_directional) {
        const Rational3 q = p - Rational3{light.position};
        const Rational3 axis{light.direction};
        const mpq_class along = dot(q, axis);
        const mpq_class cosine{light.cos_half_cone};
        const bool is_inside =
            along > 0 && along * along >= cosine * cosine * dot(q, q) * dot(axis, axis);
        EXPECT_EQ(is_out_of_light(receiver, light, counts), !is_inside);
    }
    return 12;
}

TEST(Predicates, AgreeWithGmpRationals)
{
    const bool is_full = tests::runs_full_tests();
    const int wanted = is_full ? 1'000'000 : 100'000;
    constexpr unsigned seed = 20240607;
    Questions questions{seed};
    SignCounts counts;
    for (int signs = 0, i = 0; signs < wanted; ++i) {
        const Question question = questions.next();
        signs += check(question, counts);
        ASSERT_FALSE(HasFailure())
            << "seed " << seed << ", question " << i << ": " << text(question);
    }
    // Neither path is idle: the questions are near-degenerate, but not all.
    EXPECT_GT(counts.exact, static_cast<std::uint64_t>(wanted) / 100);
    EXPECT_GT(counts.filtered, static_cast<std::uint64_t>(wanted) / 4);
}

TEST(Predicates, UseIntegersWhereDirectionsAreTiny)
{
    // Products of 2^-200 would underflow in the permanent; the signs must still be exact.
    const Corners t{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}};
    const CameraRay ray{Ray{Vec3d{0.25, 0.25, 1}, Vec3d{0x1p-200, 0, -1}}};
    EXPECT_FALSE(ray.is_well_scaled);
    SignCounts counts;
    EXPECT_EQ(hit_of(ray, {0, t}, counts).kind, Contact::cross);
    EXPECT_EQ(counts.filtered, 0U);
    EXPECT_EQ(counts.exact, 3U);
}

TEST(CompareNearnessToLight, OrdersBlockersExactly)
{
    const ExactTriangle ground{{0, {Vec3d{-4, 0, -4}, Vec3d{-4, 0, 4}, Vec3d{4, 0, 0}}}};
    SignCounts counts;
    const CameraRay ray{Ray{Vec3d{0.5, 4, 0}, Vec3d{0, -1, 0}}};
    const Receiver receiver{ground, ray, counts};
    const auto roof = [](double height, double tilt) {
        return Corners{Vec3d{-1, height - tilt, -1}, Vec3d{2, height + 2 * tilt, -1},
                       Vec3d{0.5, height + 0.5 * tilt, 2}};
    };
    Light directional;
    directional.direction = {0, -1, 0};
    Light positional;
    positional.type = LightType::spot;
    positional.position = {0.5, 3, 0};
    positional.direction = {0, -1, 0};
    for (const Light& light : {directional, positional}) {
        const auto compare = [&](const Corners& a, const Corners& b) {
            return compare_nearness_to_light(receiver, a, b, light, counts);
        };
        EXPECT_EQ(compare(roof(2, 0), roof(1, 0)), 1);
        EXPECT_EQ(compare(roof(1, 0), roof(1 + 0x1p-23, 0)), -1);
        // Both planes meet the segment at y = 1.25; turning a triangle over changes nothing.
        EXPECT_EQ(compare(roof(1, 0.5), roof(1.25, 0)), 0);
        const Corners r = roof(2, 0);
        EXPECT_EQ(compare({r[0], r[2], r[1]}, roof(1, 0)), 1);
    }
}

} // namespace
} // namespace gnomon::reference_rt
