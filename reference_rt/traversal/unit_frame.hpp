#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::reference_rt {

/// The scene's box moved to the origin and scaled by a power of two so that its largest coordinate
/// is in (½, 1]. Traversal happens in this frame: there, float32 is as fine for a scene far from
/// the origin as for one at it, and one padding serves every scene.
class UnitFrame {
public:
    explicit UnitFrame(const scene::Box& box);

    [[nodiscard]] const scene::Vec3d& centre() const { return centre_; }
    /// Unit lengths per metre: a power of two.
    [[nodiscard]] double scale() const { return scale_; }
    /// Rounds twice, the difference and nothing else.
    [[nodiscard]] scene::Vec3d from_world(const scene::Vec3d& point) const
    {
        return scale_ * (point - centre_);
    }

private:
    scene::Vec3d centre_;
    double scale_ = 1;
};

/// v scaled by a power of two so that its largest component is in [1, 2). Precondition: v is not 0.
[[nodiscard]] scene::Vec3d normalised(const scene::Vec3d& v);

/// Largest absolute component.
[[nodiscard]] inline double largest(const scene::Vec3d& v)
{
    return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

/// Half of float32's spacing at 1: what rounding to float32 may add, relative.
inline constexpr double float_roundoff = 0x1p-24;

/// How far from the frame's origin a ray may begin.
inline constexpr double farthest_origin = 8;

/// By how much the boxes that Embree traverses are larger than the triangles in them, on each side,
/// in the unit frame. The proxy ray of an exact segment must then hit the box of every triangle
/// that the segment touches. Let X be a point of the segment in a triangle, u = 2^-24; the
/// ray's point for X strays from X, in each component, by at most
///
///     8u      the origin, not farther than 8 from the frame's, rounded to float32;
///     1u      what the origin was off before: `max_origin_error`;
///     10u     the direction rounded to float32: u for each unit of way, at most 8 + √3;
///     1e-17   components below 1e-18, which Embree replaces to divide by them.
///
/// A slab's distance is (plane − origin)·(1/d): two roundings, and a reciprocal of 4u, as the
/// hardware's estimate after one Newton step has: as if the plane had moved by 6u of its distance
/// from the origin, at most 9.1, so 55u. The box is rounded to float32: 1u. The sum is 75u.
/// Axis-parallel rays need nothing else: their origin is strictly inside the padded slab.
inline constexpr double box_padding = 96 * float_roundoff;
/// What the origin of a proxy ray may be off before it is rounded, in the unit frame.
inline constexpr double max_origin_error = float_roundoff;

} // namespace gnomon::reference_rt
