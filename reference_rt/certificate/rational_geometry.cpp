#include "reference_rt/certificate/rational_geometry.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon::reference_rt::certificate {

namespace {

constexpr int double_digits = 53;

/// (x − base) times the weight of x: x − weight·base.
Vector offset(const Point& x, const Vector& base)
{
    return x.vector - x.weight * base;
}

Vector normal(const Triangle& triangle)
{
    return cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

/// The values at P and at the light of a linear function that is not negative inside the triangle.
struct EdgeValues {
    Rational at_point;
    Rational at_light;
};

/// The interval of τ in which P + τ·light lies inside the edges.
struct Bounds {
    Fraction lower; ///< starts at 0, which is P and excluded
    std::optional<Fraction> upper;
    bool is_empty = false;

    /// Keeps the τ with at_point + τ·at_light ≥ 0.
    void clip(const EdgeValues& edge)
    {
        const Sign growth = edge.at_light.sign();
        if (growth == 0) {
            is_empty = is_empty || edge.at_point.sign() < 0;
        } else if (growth > 0) {
            const Fraction bound{-edge.at_point, edge.at_light};
            lower = compare(bound, lower) > 0 ? bound : lower;
        } else {
            const Fraction bound{edge.at_point, -edge.at_light};
            upper = !upper || compare(bound, *upper) < 0 ? bound : *upper;
        }
    }
    [[nodiscard]] bool admits_a_positive() const
    {
        return !is_empty &&
               (!upper || (upper->numerator.sign() > 0 && compare(lower, *upper) <= 0));
    }
};

} // namespace

Rational::Rational(double value)
{
    if (value == 0) {
        return;
    }
    const auto digits =
        static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent_), double_digits));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(digits));
    // The arithmetic shift is exact, also for negative numbers: only zeros are shifted out.
    mantissa_ = digits >> zeros;
    exponent_ += zeros - double_digits;
}

double Rational::rounded() const
{
    // Keeps 64 bits before the conversion, so that the mantissa cannot overflow.
    const int length = mantissa_ == 0 ? 0 : static_cast<int>(msb(abs(mantissa_))) + 1;
    const int excess = std::max(length - 64, 0);
    const Integer kept = abs(mantissa_) >> static_cast<unsigned>(excess);
    const double magnitude =
        std::ldexp(static_cast<double>(static_cast<std::uint64_t>(kept)), exponent_ + excess);
    return sign() < 0 ? -magnitude : magnitude;
}

Rational operator+(const Rational& a, const Rational& b)
{
    if (a.sign() == 0) {
        return b;
    }
    if (b.sign() == 0) {
        return a;
    }
    if (a.exponent_ < b.exponent_) {
        return b + a;
    }
    const auto shift = static_cast<unsigned>(a.exponent_ - b.exponent_);
    return {(a.mantissa_ << shift) + b.mantissa_, b.exponent_};
}

Sign compare(const Fraction& a, const Fraction& b)
{
    return (a.numerator * b.denominator - b.numerator * a.denominator).sign();
}

Vector operator+(const Vector& a, const Vector& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

Vector operator-(const Vector& a, const Vector& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Vector operator*(const Rational& s, const Vector& a)
{
    return {s * a.x, s * a.y, s * a.z};
}

Rational dot(const Vector& a, const Vector& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector cross(const Vector& a, const Vector& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Triangle exact_triangle(const std::array<scene::Vec3f, 3>& corners)
{
    return {Vector{scene::Vec3d{corners[0]}}, Vector{scene::Vec3d{corners[1]}},
            Vector{scene::Vec3d{corners[2]}}};
}

Point light_point(const scene::Light& light)
{
    return light.has_position() ? Point{Vector{light.position}, Rational{1.0}}
                                : Point{Vector{-light.direction}, Rational{}};
}

Sign orientation(const Vector& u, const Vector& v, const Point& x, const Point& y)
{
    return dot(cross(v - u, offset(x, u)), offset(y, u)).sign();
}

std::optional<Fraction> plane_parameter(const CameraRay& ray, const Triangle& triangle)
{
    const Vector n = normal(triangle);
    const Rational nu = dot(n, triangle[0] - ray.origin);
    const Rational delta = dot(n, ray.direction);
    switch (delta.sign()) {
    case 0:
        return std::nullopt;
    case 1:
        return Fraction{nu, delta};
    default:
        return Fraction{-nu, -delta};
    }
}

std::optional<Fraction> hit_parameter(const CameraRay& ray, const Triangle& triangle)
{
    const Point origin{ray.origin};
    const Point ahead{ray.direction, Rational{}};
    bool is_kept_by_culling = false;
    bool is_right = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const Sign side = orientation(triangle[i], triangle[(i + 1) % 3], origin, ahead);
        is_kept_by_culling = is_kept_by_culling || side > 0;
        is_right = is_right || side < 0;
        if (is_kept_by_culling && is_right) {
            return std::nullopt;
        }
    }
    return plane_parameter(ray, triangle);
}

Point point_at(const CameraRay& ray, const Fraction& t)
{
    return {t.denominator * ray.origin + t.numerator * ray.direction, t.denominator};
}

bool is_within(const Rational& numerator, const Rational& weight, double value, double radius)
{
    const Rational error = numerator - Rational{value} * weight;
    const Rational limit = Rational{radius} * weight;
    return (limit - error).sign() >= 0 && (limit + error).sign() >= 0;
}

ContactSigns contact_signs(const Point& p, const Point& light, const Triangle& triangle)
{
    const auto& [u, v, w] = triangle;
    return {{orientation(u, v, light, p), orientation(v, w, light, p), orientation(w, u, light, p)},
            orientation(u, v, Point{w}, p),
            orientation(u, v, Point{w}, light)};
}

ContactKind contact_kind(const ContactSigns& signs)
{
    if (signs.point == 0 && signs.light == 0) {
        return ContactKind::in_plane;
    }
    const bool is_between = signs.point * signs.light < 0;
    const bool is_mixed = std::ranges::min(signs.edge) < 0 && std::ranges::max(signs.edge) > 0;
    if (!is_between || is_mixed) {
        return ContactKind::none;
    }
    switch (std::ranges::count(signs.edge, 0)) {
    case 0:
        return ContactKind::crossing;
    case 1:
        return ContactKind::through_edge;
    default:
        return ContactKind::through_corner;
    }
}

bool meets_in_plane(const Point& p, const Point& light, const Triangle& triangle)
{
    // The third corner tells which side of a plane through an edge is inside.
    const Point above{normal(triangle), Rational{}};
    Bounds tau;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector& from = triangle[i];
        const Vector wall = cross(triangle[(i + 1) % 3] - from, above.vector);
        const Rational inside = dot(wall, triangle[(i + 2) % 3] - from);
        const Vector inward = Rational{static_cast<double>(inside.sign())} * wall;
        tau.clip({dot(inward, offset(p, from)), dot(inward, offset(light, from))});
    }
    return tau.admits_a_positive();
}

bool faces_away(const CameraRay& ray, const Point& light, const Triangle& triangle)
{
    const Point corner{triangle[2]};
    const Sign lit_side = orientation(triangle[0], triangle[1], corner, light);
    const Sign seen_side = orientation(triangle[0], triangle[1], corner, Point{ray.origin});
    return lit_side == 0 || lit_side != seen_side;
}

bool is_in_cone(const Point& p, const scene::Light& spot)
{
    const Vector from_light = offset(p, Vector{spot.position});
    const Vector axis{spot.direction};
    const Rational along = dot(from_light, axis);
    const Rational cosine{spot.cos_half_cone};
    const Rational limit = cosine * cosine * dot(from_light, from_light) * dot(axis, axis);
    return along.sign() > 0 && (along * along - limit).sign() >= 0;
}

} // namespace gnomon::reference_rt::certificate
