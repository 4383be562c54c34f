#pragma once

#include "reference_rt/contact.hpp"
#include "scene/camera.hpp"
#include "scene/light.hpp"
#include "scene/triangles.hpp"
#include "scene/vec.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cstdint>
#include <optional>

/// Signs computed in double from the exact inputs. What they mean is decided elsewhere
/// (contact.hpp), so that an exact evaluation can take the place of this one.
namespace gnomon::reference_rt {

/// A triangle's corners; float32 values held as doubles, hence exact.
using Corners = std::array<scene::Vec3d, 3>;
[[nodiscard]] inline Corners corners_of(const scene::TriangleScene& scene, std::uint32_t triangle)
{
    const auto corners = scene.corners(triangle);
    return {scene::Vec3d{corners[0]}, scene::Vec3d{corners[1]}, scene::Vec3d{corners[2]}};
}

/// The cross product with every term positive.
[[nodiscard]] inline scene::Vec3d cross_permanent(const scene::Vec3d& a, const scene::Vec3d& b)
{
    const scene::Vec3d p = glm::abs(a);
    const scene::Vec3d q = glm::abs(b);
    return {p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
}

/// The surface point of a pixel by its definition: P = E + (ν/δ)d on the plane of T = (a, b, c),
/// with n = (b − a) × (c − a), δ = n·d, ν = n·(a − E). Usable when δ is not 0.
struct Receiver {
    std::uint32_t triangle = scene::no_triangle; ///< T
    scene::Ray ray{};                            ///< E, d
    scene::Vec3d corner{};                       ///< a
    scene::Vec3d normal{};                       ///< n
    scene::Vec3d normal_permanent{}; ///< the sums of absolute products in n's components
    double delta = 0;
    double nu = 0;

    /// P rounded to double [m].
    [[nodiscard]] scene::Vec3d point() const { return ray.origin + (nu / delta) * ray.direction; }
};
[[nodiscard]] inline Receiver make_receiver(std::uint32_t triangle, const Corners& corners,
                                            const scene::Ray& ray)
{
    const auto& [a, b, c] = corners;
    Receiver receiver{.triangle = triangle, .ray = ray, .corner = a};
    receiver.normal = glm::cross(b - a, c - a);
    receiver.normal_permanent = cross_permanent(b - a, c - a);
    receiver.delta = glm::dot(receiver.normal, ray.direction);
    receiver.nu = glm::dot(receiver.normal, a - ray.origin);
    return receiver;
}

/// Where a camera ray meets a triangle: t = ν/δ, and the bound of t's rounding error.
struct CameraHit {
    double t = 0;
    double t_error = 0;
};
/// The hit with the closed triangle, if the ray's line meets it at one point.
[[nodiscard]] std::optional<CameraHit> camera_hit(const scene::Ray& ray, const Corners& corners);

/// True when the light is behind, or in the plane of, the side of T that the camera sees.
[[nodiscard]] bool is_attached(const Receiver& receiver, const scene::Light& light);

/// True when P is outside a spot's cone (DESIGN §7); never for a directional light.
[[nodiscard]] bool is_out_of_light(const Receiver& receiver, const scene::Light& light);

/// True when double arithmetic cannot tell that S leaves the plane of T.
[[nodiscard]] bool is_coplanar(const Receiver& receiver, const Corners& s);

/// The five signs of S against the segment from P to the light. The signs of an edge that two
/// triangles share are exact opposites, so that no segment slips between them.
///
///     sgn N·(P − o) = sgn(δ) · sgn(N·(δ(E − o) + νd))
[[nodiscard]] ShadowSigns shadow_signs(const Receiver& receiver, const Corners& s,
                                       const scene::Light& light);

/// Side of `apex` from the plane through the light and the edge (u, v).
[[nodiscard]] Sign apex_side(const scene::Light& light, const scene::Vec3d& u,
                             const scene::Vec3d& v, const scene::Vec3d& apex);

/// True when the open segment P→light, lying in the plane of S, meets the closed triangle S.
[[nodiscard]] bool runs_through(const Receiver& receiver, const Corners& s,
                                const scene::Light& light);

} // namespace gnomon::reference_rt
