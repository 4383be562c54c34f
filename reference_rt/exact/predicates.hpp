#pragma once

#include "reference_rt/exact/arithmetic.hpp"
#include "reference_rt/exact/contact.hpp"
#include "reference_rt/exact/receiver.hpp"
#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstdint>

/// Exact predicates. Each sign is decided by the filter in doubles, else by exact arithmetic.
/// contact.hpp interprets the signs.
namespace gnomon::reference_rt {

/// P − origin within a relative 2^-50, for any conditioning of δ. Precondition: δ is not 0.
[[nodiscard]] scene::Vec3d exact_offset(const Receiver& receiver, const scene::Vec3d& origin);
/// P, within a few roundings of its size. Precondition: δ is not 0.
[[nodiscard]] scene::Vec3d sharp_point(const Receiver& receiver);
/// E + t·d − origin, within a relative 2^-50.
[[nodiscard]] scene::Vec3d exact_offset(const scene::Ray& ray, double t,
                                        const scene::Vec3d& origin);

/// The side on which a ray's line passes the edge from u to v: ((u − E) × (v − u))·d.
[[nodiscard]] Sign passing_side(const CameraRay& ray, const scene::Vec3d& u, const scene::Vec3d& v,
                                SignCounts& counts);

/// Whether ν/δ > near. Precondition: δ is not 0.
[[nodiscard]] bool is_beyond(const Receiver& hit, double near, SignCounts& counts);

/// −1 if hit a is before b on their common ray, 1 if after, 0 if at the same point.
[[nodiscard]] Sign compare_distance(const Receiver& a, const Receiver& b, SignCounts& counts);

/// Whether S lies in the plane of T.
[[nodiscard]] bool is_coplanar(const Receiver& receiver, const Corners& s, SignCounts& counts);

/// The side of the light of a triangle's plane: 1 if it sees the corners counter-clockwise, −1 if
/// clockwise, 0 if in the plane.
[[nodiscard]] Sign light_side(const Corners& corners, const scene::Light& light,
                              SignCounts& counts);
[[nodiscard]] Sign light_side(const ExactTriangle& face, const scene::Light& light,
                              SignCounts& counts);

/// Whether the light is in the plane of T or behind the side that the camera sees.
/// @param light_side  side of the light of the plane of T.
[[nodiscard]] constexpr bool is_attached(const Receiver& receiver, Sign light_side)
{
    // −d points to the camera, and n·(−d) = −δ.
    return light_side != -receiver.delta_sign;
}

/// Whether P is outside a spot's cone (docs/truth.md); false for other lights.
[[nodiscard]] bool is_out_of_light(const Receiver& receiver, const scene::Light& light,
                                   SignCounts& counts);

/// The side of P of the plane of S: σ0 below.
[[nodiscard]] Sign point_sign(const Receiver& receiver, const Corners& s, SignCounts& counts);

/// The side of P of the plane through the light and the edge (u, v): ε(u, v) below.
[[nodiscard]] Sign point_side(const Receiver& receiver, const scene::Vec3d& u,
                              const scene::Vec3d& v, const scene::Light& light, SignCounts& counts);

/// The five signs of S for the open segment from P to the light.
///
/// With g(x) = L − x, or −ℓ for a directional light that travels along ℓ:
///
///     ε(u, v) = sgn ((v − u) × g(u))·(P − u)     for the three edges
///     σ0 = sgn M·(P − u),   σ1 = sgn M·g(u),   M = (v − u) × (w − u)
///     sgn N·(P − o) = sgn(δ) · sgn(δ N·(E − o) + ν N·d)
[[nodiscard]] ShadowSigns shadow_signs(const Receiver& receiver, const Corners& s,
                                       const scene::Light& light, SignCounts& counts);

/// The side of `apex` of the plane through the light and the edge (u, v).
[[nodiscard]] Sign apex_side(const scene::Light& light, const scene::Vec3d& u,
                             const scene::Vec3d& v, const scene::Vec3d& apex, SignCounts& counts);

/// An edge of a triangle, and the opposite corner.
struct EdgeOf {
    scene::Vec3d u, v, apex;
};
/// @param edge  0 for the edge from the first corner to the second.
[[nodiscard]] inline EdgeOf edge_of(const Corners& corners, int edge)
{
    const auto i = static_cast<std::size_t>(edge);
    return {corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]};
}

/// Whether a light ray that meets both edges passes through the triangles' joint surface: the edges
/// are equal, and the apexes lie on opposite sides.
[[nodiscard]] bool forms_seam(const EdgeOf& a, const EdgeOf& b, const scene::Light& light,
                              SignCounts& counts);

/// Whether the open segment P→light, which lies in the plane of S, meets the closed triangle S.
[[nodiscard]] bool runs_through(const Receiver& receiver, const Corners& s,
                                const scene::Light& light);

/// 1 if the segment P→light meets the plane of a nearer to the light than that of b, −1 if farther,
/// 0 if at the same point. Precondition: it crosses both planes between P and the light.
[[nodiscard]] Sign compare_nearness_to_light(const Receiver& receiver, const Corners& a,
                                             const Corners& b, const scene::Light& light,
                                             SignCounts& counts);

} // namespace gnomon::reference_rt
