#pragma once

#include "scene/camera/camera.hpp"
#include "scene/light/light.hpp"
#include "scene/vec.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

/// The certificate's exact geometry in rational numbers, without rounding.
///
/// It includes nothing from reference_rt on purpose, so that it cannot repeat a mistake of the
/// predicates that it checks.
namespace gnomon::reference_rt::certificate {

/// −1, 0 or 1.
using Sign = int;

/// A rational number m·2^e. Floats, doubles and their sums, differences and products have this
/// form, and division is never needed.
class Rational {
public:
    Rational() = default;
    /// @param value  must be finite.
    explicit Rational(double value);

    [[nodiscard]] Sign sign() const { return mantissa_.sign(); }
    /// A double within a few ulp; overflows to infinity.
    [[nodiscard]] double rounded() const;

    friend Rational operator+(const Rational& a, const Rational& b);
    friend Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
    friend Rational operator*(const Rational& a, const Rational& b)
    {
        return {a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_};
    }
    friend Rational operator-(const Rational& a) { return {-a.mantissa_, a.exponent_}; }

private:
    /// Holds most numbers of a shadow test without allocating, and grows if needed.
    using Integer = boost::multiprecision::number<
        boost::multiprecision::cpp_int_backend<256, 0, boost::multiprecision::signed_magnitude,
                                               boost::multiprecision::unchecked,
                                               std::allocator<boost::multiprecision::limb_type>>,
        boost::multiprecision::et_off>;

    Rational(Integer mantissa, int exponent) : mantissa_{std::move(mantissa)}, exponent_{exponent}
    {
    }

    Integer mantissa_ = 0;
    int exponent_ = 0;
};

/// A quotient of two numbers; its denominator is positive.
struct Fraction {
    Rational numerator;
    Rational denominator{1.0};
};
/// Sign of a − b.
[[nodiscard]] Sign compare(const Fraction& a, const Fraction& b);

struct Vector {
    Rational x, y, z;

    Vector() = default;
    Vector(Rational first, Rational second, Rational third)
        : x{std::move(first)},
          y{std::move(second)},
          z{std::move(third)}
    {
    }
    explicit Vector(const scene::Vec3d& v) : x{v.x}, y{v.y}, z{v.z} {}

    friend Vector operator+(const Vector& a, const Vector& b);
    friend Vector operator-(const Vector& a, const Vector& b);
    friend Vector operator*(const Rational& s, const Vector& a);
};
[[nodiscard]] Rational dot(const Vector& a, const Vector& b);
[[nodiscard]] Vector cross(const Vector& a, const Vector& b);

/// A point in homogeneous coordinates: `vector` / `weight`, or the point at infinity along `vector`
/// if the weight is 0. Weights are never negative.
///
/// The open segment between two such points is the set of their positive combinations, also if one
/// is at infinity. One formula serves spot and directional lights.
struct Point {
    Vector vector;
    Rational weight{1.0};
};

/// |numerator / weight − value| ≤ radius, for a positive weight.
[[nodiscard]] bool is_within(const Rational& numerator, const Rational& weight, double value,
                             double radius);

using Triangle = std::array<Vector, 3>;
[[nodiscard]] Triangle exact_triangle(const std::array<scene::Vec3f, 3>& corners);

/// A spot light's position, or the point at infinity towards a directional light.
[[nodiscard]] Point light_point(const scene::Light& light);

/// The side of `y` from the plane through u, v and x: the sign of ((v − u) × (x − u))·(y − u), with
/// x and y in homogeneous coordinates.
[[nodiscard]] Sign orientation(const Vector& u, const Vector& v, const Point& x, const Point& y);

/// A camera ray with exact origin and direction.
struct CameraRay {
    Vector origin;
    Vector direction;

    explicit CameraRay(const scene::Ray& ray) : origin{ray.origin}, direction{ray.direction} {}
};

/// t where origin + t·direction meets the triangle's plane; empty if parallel.
[[nodiscard]] std::optional<Fraction> plane_parameter(const CameraRay& ray,
                                                      const Triangle& triangle);
/// As `plane_parameter`, but also empty if the line misses the closed triangle.
[[nodiscard]] std::optional<Fraction> hit_parameter(const CameraRay& ray, const Triangle& triangle);
/// P: origin + t·direction.
[[nodiscard]] Point point_at(const CameraRay& ray, const Fraction& t);

/// The signs that decide how a triangle (u, v, w) meets the open segment from P to the light.
struct ContactSigns {
    std::array<Sign, 3> edge{}; ///< side of P of the planes through the light and uv, vw, wu
    Sign point = 0;             ///< side of P of the triangle's plane
    Sign light = 0;             ///< side of the light of the triangle's plane
};
[[nodiscard]] ContactSigns contact_signs(const Point& p, const Point& light,
                                         const Triangle& triangle);

enum class ContactKind : std::uint8_t {
    none,         ///< apart, or meeting only at P or at the light
    crossing,     ///< properly through the interior
    through_edge, ///< exactly through one edge, not at its ends
    through_corner,
    in_plane, ///< P and the light lie in the triangle's plane
};
[[nodiscard]] ContactKind contact_kind(const ContactSigns& signs);

/// Whether the open segment P→light, which lies in the triangle's plane, meets the closed triangle.
[[nodiscard]] bool meets_in_plane(const Point& p, const Point& light, const Triangle& triangle);

/// Whether the light is in the triangle's plane, or behind the side that the ray's origin sees.
[[nodiscard]] bool faces_away(const CameraRay& ray, const Point& light, const Triangle& triangle);

/// Whether P is inside the spot's cone or on its boundary: (P − L)·a > 0 and ((P − L)·a)² ≥ c²·|P −
/// L|²·|a|².
[[nodiscard]] bool is_in_cone(const Point& p, const scene::Light& spot);

} // namespace gnomon::reference_rt::certificate
