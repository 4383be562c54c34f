#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"

#include <boost/multiprecision/gmp.hpp>

#include <cstdint>
#include <optional>

/// An independent oracle in rationals: solves for the hit (Cramer's rule, barycentric coordinates)
/// instead of evaluating the reference's five signs.
namespace gnomon::reference_rt::test {

using Rational = boost::multiprecision::mpq_rational;

struct RationalVec {
    Rational x, y, z;

    RationalVec() = default;
    RationalVec(Rational x_in, Rational y_in, Rational z_in)
        : x{std::move(x_in)},
          y{std::move(y_in)},
          z{std::move(z_in)}
    {
    }
    explicit RationalVec(const scene::Vec3d& v) : x{v.x}, y{v.y}, z{v.z} {}

    friend RationalVec operator+(const RationalVec& a, const RationalVec& b)
    {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend RationalVec operator-(const RationalVec& a, const RationalVec& b)
    {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend RationalVec operator*(const Rational& s, const RationalVec& a)
    {
        return {s * a.x, s * a.y, s * a.z};
    }
};

inline Rational dot(const RationalVec& a, const RationalVec& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline RationalVec cross(const RationalVec& a, const RationalVec& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Where origin + t·direction meets a triangle's plane: t, and barycentric coordinates.
struct RationalHit {
    Rational t, u, v;

    [[nodiscard]] bool is_inside() const { return u > 0 && v > 0 && u + v < 1; }
    [[nodiscard]] bool is_outside() const { return u < 0 || v < 0 || u + v > 1; }
};

inline std::optional<RationalHit> hit_of(const RationalVec& origin, const RationalVec& direction,
                                         const std::array<scene::Vec3f, 3>& triangle)
{
    const RationalVec a{scene::Vec3d{triangle[0]}};
    const RationalVec e1 = RationalVec{scene::Vec3d{triangle[1]}} - a;
    const RationalVec e2 = RationalVec{scene::Vec3d{triangle[2]}} - a;
    const RationalVec p = cross(direction, e2);
    const Rational determinant = dot(e1, p);
    if (determinant == 0) {
        return std::nullopt;
    }
    const RationalVec s = origin - a;
    const RationalVec q = cross(s, e1);
    return RationalHit{dot(e2, q) / determinant, dot(s, p) / determinant,
                       dot(direction, q) / determinant};
}

/// P: the ray's hit with the plane of the triangle.
inline RationalVec exact_point(const scene::Ray& ray, const std::array<scene::Vec3f, 3>& triangle)
{
    const RationalVec origin{ray.origin};
    const RationalVec direction{ray.direction};
    return origin + hit_of(origin, direction, triangle)->t * direction;
}

/// How a triangle meets the open segment P→light, when it is not in the segment's plane.
enum class ExactContact : std::uint8_t { none, cross, boundary };

inline ExactContact exact_contact(const RationalVec& point, const scene::Light& light,
                                  const std::array<scene::Vec3f, 3>& triangle)
{
    const bool is_directional = light.type == scene::LightType::directional;
    const RationalVec step =
        is_directional ? RationalVec{-light.direction} : RationalVec{light.position} - point;
    const auto hit = hit_of(point, step, triangle);
    if (!hit || hit->t <= 0 || (!is_directional && hit->t >= 1) || hit->is_outside()) {
        return ExactContact::none;
    }
    return hit->is_inside() ? ExactContact::cross : ExactContact::boundary;
}

} // namespace gnomon::reference_rt::test
