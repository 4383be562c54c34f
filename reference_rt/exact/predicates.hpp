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

/// Exact answers about exact inputs: each sign is decided in double where the error bound allows,
/// else in integers. What the signs mean is decided in contact.hpp.
namespace gnomon::reference_rt {

/// P − origin to within 2^-50 of its size, however badly δ is conditioned.
/// Precondition: δ is not 0.
[[nodiscard]] scene::Vec3d exact_offset(const Receiver& receiver, const scene::Vec3d& origin);
/// P rounded, to within a few roundings of its size.
/// Precondition: δ is not 0.
[[nodiscard]] scene::Vec3d sharp_point(const Receiver& receiver);
/// E + t·d − origin to within 2^-50 of its size.
[[nodiscard]] scene::Vec3d exact_offset(const scene::Ray& ray, double t,
                                        const scene::Vec3d& origin);

/// The side on which a ray's line passes the edge from u to v: ((u − E) × (v − u))·d.
[[nodiscard]] Sign passing_side(const CameraRay& ray, const scene::Vec3d& u, const scene::Vec3d& v,
                                SignCounts& counts);

/// True when ν/δ > near. Precondition: δ is not 0.
[[nodiscard]] bool is_beyond(const Receiver& hit, double near, SignCounts& counts);

/// −1 when hit a comes before b on their common ray, 1 when after, 0 at the same point.
[[nodiscard]] Sign compare_distance(const Receiver& a, const Receiver& b, SignCounts& counts);

/// True when S lies in the plane of T.
[[nodiscard]] bool is_coplanar(const Receiver& receiver, const Corners& s, SignCounts& counts);

/// Side of the light from the plane of a triangle: 1 where it sees the corners counter-clockwise,
/// −1 where clockwise, 0 in the plane.
[[nodiscard]] Sign light_side(const Corners& corners, const scene::Light& light,
                              SignCounts& counts);
[[nodiscard]] Sign light_side(const ExactTriangle& face, const scene::Light& light,
                              SignCounts& counts);

/// True when the light is behind, or in the plane of, the side of T that the camera sees.
/// @param light_side  of the light from the plane of T.
[[nodiscard]] constexpr bool is_attached(const Receiver& receiver, Sign light_side)
{
    // Towards the camera is −d, and n·(−d) = −δ.
    return light_side != -receiver.delta_sign;
}

/// True when P is outside a spot's cone (docs/truth.md); never for other lights.
[[nodiscard]] bool is_out_of_light(const Receiver& receiver, const scene::Light& light,
                                   SignCounts& counts);

/// Side of P from the plane of S: σ0 below.
[[nodiscard]] Sign point_sign(const Receiver& receiver, const Corners& s, SignCounts& counts);

/// Side of P from the plane through the light and the edge (u, v): ε(u, v) below.
[[nodiscard]] Sign point_side(const Receiver& receiver, const scene::Vec3d& u,
                              const scene::Vec3d& v, const scene::Light& light, SignCounts& counts);

/// How S stands to the open segment from P to the light: its five signs.
///
/// With g(x) = L − x, or −ℓ for a directional light that travels along ℓ:
///
///     ε(u, v) = sgn ((v − u) × g(u))·(P − u)     for the three edges
///     σ0 = sgn M·(P − u),   σ1 = sgn M·g(u),   M = (v − u) × (w − u)
///     sgn N·(P − o) = sgn(δ) · sgn(δ N·(E − o) + ν N·d)
[[nodiscard]] ShadowSigns shadow_signs(const Receiver& receiver, const Corners& s,
                                       const scene::Light& light, SignCounts& counts);

/// Side of `apex` from the plane through the light and the edge (u, v).
[[nodiscard]] Sign apex_side(const scene::Light& light, const scene::Vec3d& u,
                             const scene::Vec3d& v, const scene::Vec3d& apex, SignCounts& counts);

/// An edge of a triangle, and the corner opposite.
struct EdgeOf {
    scene::Vec3d u, v, apex;
};
/// @param edge  0 for the edge from the first corner to the second.
[[nodiscard]] inline EdgeOf edge_of(const Corners& corners, int edge)
{
    const auto i = static_cast<std::size_t>(edge);
    return {corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]};
}

/// True when two triangles' surface passes through a ray of the light that meets both edges: they
/// are the same edge, and the apexes on opposite sides of it.
[[nodiscard]] bool forms_seam(const EdgeOf& a, const EdgeOf& b, const scene::Light& light,
                              SignCounts& counts);

/// True when the open segment P→light, lying in the plane of S, meets the closed triangle S.
[[nodiscard]] bool runs_through(const Receiver& receiver, const Corners& s,
                                const scene::Light& light);

/// 1 when the segment P→light meets the plane of a nearer to the light than the plane of b, −1 when
/// farther, 0 at the same point. Precondition: it crosses both planes between P and the light.
[[nodiscard]] Sign compare_nearness_to_light(const Receiver& receiver, const Corners& a,
                                             const Corners& b, const scene::Light& light,
                                             SignCounts& counts);

} // namespace gnomon::reference_rt
