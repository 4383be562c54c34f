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

/// Exact geometry of the certificate: every number is rational, nothing is ever rounded.
///
/// It stands alone on purpose and includes nothing of this folder: a mistake made in the predicates
/// that decide the truth must not be repeated by the one who checks them.
namespace gnomon::reference_rt::certificate {

/// −1, 0 or 1.
using Sign = int;

/// A rational number m·2^e. Every float and double is one, and so are sums, differences and
/// products of such numbers; no division is ever needed.
class Rational {
public:
    Rational() = default;
    /// @param value  finite.
    explicit Rational(double value);

    [[nodiscard]] Sign sign() const { return mantissa_.sign(); }
    /// The nearest double but for a few ulp; overflows to infinity.
    [[nodiscard]] double rounded() const;

    friend Rational operator+(const Rational& a, const Rational& b);
    friend Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
    friend Rational operator*(const Rational& a, const Rational& b)
    {
        return {a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_};
    }
    friend Rational operator-(const Rational& a) { return {-a.mantissa_, a.exponent_}; }

private:
    /// Holds most numbers of a shadow test without an allocation, and grows where it must.
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

/// A point in homogeneous coordinates: `vector` / `weight`, or with weight 0 the point at infinity
/// in the direction of `vector`. Weights are never negative.
///
/// The open segment between two such points is every sum of positive multiples of them, whether one
/// is at infinity or not: one formula serves a spot and a directional light.
struct Point {
    Vector vector;
    Rational weight{1.0};
};

/// |numerator / weight − value| ≤ radius, for a positive weight.
[[nodiscard]] bool is_within(const Rational& numerator, const Rational& weight, double value,
                             double radius);

using Triangle = std::array<Vector, 3>;
[[nodiscard]] Triangle exact_triangle(const std::array<scene::Vec3f, 3>& corners);

/// A spot's position, or the point at infinity from which a directional light comes.
[[nodiscard]] Point light_point(const scene::Light& light);

/// The side of `y` from the plane through u, v and x: the sign of ((v − u) × (x − u))·(y − u), with
/// x and y taken by their homogeneous coordinates.
[[nodiscard]] Sign orientation(const Vector& u, const Vector& v, const Point& x, const Point& y);

/// A camera ray: origin and direction, as exact as their bits.
struct CameraRay {
    Vector origin;
    Vector direction;

    explicit CameraRay(const scene::Ray& ray) : origin{ray.origin}, direction{ray.direction} {}
};

/// t where origin + t·direction meets the plane of the triangle; empty if it is parallel to it.
[[nodiscard]] std::optional<Fraction> plane_parameter(const CameraRay& ray,
                                                      const Triangle& triangle);
/// As `plane_parameter`, but empty as well where the line misses the closed triangle.
[[nodiscard]] std::optional<Fraction> hit_parameter(const CameraRay& ray, const Triangle& triangle);
/// P: origin + t·direction.
[[nodiscard]] Point point_at(const CameraRay& ray, const Fraction& t);

/// The signs that say how a triangle (u, v, w) meets the open segment from P to the light.
struct ContactSigns {
    std::array<Sign, 3> edge{}; ///< of P from the planes through the light and uv, vw, wu
    Sign point = 0;             ///< of P from the triangle's plane
    Sign light = 0;             ///< of the light from the triangle's plane
};
[[nodiscard]] ContactSigns contact_signs(const Point& p, const Point& light,
                                         const Triangle& triangle);

/// What the signs mean.
enum class ContactKind : std::uint8_t {
    none,         ///< apart from each other, or met at P or at the light alone
    crossing,     ///< properly through the interior
    through_edge, ///< exactly through one edge, not at its ends
    through_corner,
    in_plane, ///< P and the light are in the triangle's plane
};
[[nodiscard]] ContactKind contact_kind(const ContactSigns& signs);

/// True when the open segment P→light, lying in the plane of the triangle, meets the closed
/// triangle.
[[nodiscard]] bool meets_in_plane(const Point& p, const Point& light, const Triangle& triangle);

/// True when the light is behind, or in the plane of, the side of the triangle that the ray's
/// origin sees.
[[nodiscard]] bool faces_away(const CameraRay& ray, const Point& light, const Triangle& triangle);

/// True when P is inside the spot's cone (boundary included): (P − L)·a > 0 and
/// ((P − L)·a)² ≥ c²·|P − L|²·|a|².
[[nodiscard]] bool is_in_cone(const Point& p, const scene::Light& spot);

} // namespace gnomon::reference_rt::certificate
