#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::reference_rt {

/// The scene's box, moved to the origin and scaled by a power of two so that its largest coordinate
/// is in (½, 1]. Traversal uses this frame: float32 is then as precise for a scene far from the
/// origin, and one padding fits every scene.
class UnitFrame {
public:
    explicit UnitFrame(const scene::Box& box);

    [[nodiscard]] const scene::Vec3d& centre() const { return centre_; }
    /// Unit lengths per metre: a power of two.
    [[nodiscard]] double scale() const { return scale_; }
    /// Only the difference rounds.
    [[nodiscard]] scene::Vec3d from_world(const scene::Vec3d& point) const
    {
        return scale_ * (point - centre_);
    }

private:
    scene::Vec3d centre_;
    double scale_ = 1;
};

/// Largest absolute component.
[[nodiscard]] inline double largest(const scene::Vec3d& v)
{
    return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

/// v scaled by a power of two so that its largest component is in [1, 2). Precondition: v is not 0.
[[nodiscard]] inline scene::Vec3d normalised(const scene::Vec3d& v)
{
    return std::ldexp(1.0, -std::ilogb(largest(v))) * v;
}

inline UnitFrame::UnitFrame(const scene::Box& box) : centre_{scene::Vec3f{box.centre()}}
{
    const double reach = std::max(largest(box.upper - centre_), largest(box.lower - centre_));
    scale_ = std::ldexp(1.0, -(std::ilogb(reach) + 1));
}

/// Half of float32's spacing at 1: the relative rounding error.
inline constexpr double float_roundoff = 0x1p-24;

/// The largest distance of a ray's start from the frame's origin.
inline constexpr double farthest_origin = 8;

/// The padding of Embree's triangle boxes on each side, in the unit frame. It makes the proxy ray
/// of an exact segment hit the box of every triangle that the segment touches. Let X be a point of
/// the segment in a triangle, u = 2^-24; the ray's point for X strays from X, in each component, by
/// at most
///
///     8u      rounding the origin, at most 8 from the frame's, to float32;
///     1u      the origin's error before rounding: `max_origin_error`;
///     10u     rounding the direction to float32: u per unit of distance, at most 8 + √3;
///     1e-17   components below 1e-18, which Embree replaces to divide by them.
///
/// A slab's distance is (plane − origin)·(1/d): two roundings, and a reciprocal of 4u, the error of
/// the hardware estimate after one Newton step. This equals moving the plane by 6u times its
/// distance from the origin, at most 9.1, so 55u. The box is rounded to float32: 1u. The sum is
/// 75u. Axis-parallel rays need no more, as their origin is strictly inside the padded slab.
inline constexpr double box_padding = 96 * float_roundoff;
/// The allowed error of a proxy ray's origin before rounding, in the unit frame.
inline constexpr double max_origin_error = float_roundoff;

} // namespace gnomon::reference_rt
