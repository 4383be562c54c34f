#pragma once

#include "reference_rt/exact/arithmetic.hpp"
#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gnomon::reference_rt {

/// A triangle's corners: float32 values as doubles, so they are exact.
using Corners = std::array<scene::Vec3d, 3>;
[[nodiscard]] inline Corners corners_of(const scene::TriangleScene& scene, std::uint32_t triangle)
{
    const auto corners = scene.corners(triangle);
    return {scene::Vec3d{corners[0]}, scene::Vec3d{corners[1]}, scene::Vec3d{corners[2]}};
}

/// A triangle's index and corners, which decide its contacts with rays and segments.
struct SceneTriangle {
    std::uint32_t triangle = scene::no_triangle;
    Corners corners{};
};
[[nodiscard]] inline SceneTriangle triangle_of(const scene::TriangleScene& scene,
                                               std::uint32_t triangle)
{
    return {triangle, corners_of(scene, triangle)};
}

/// A pixel's ray.
struct CameraRay {
    scene::Ray ray{};           ///< E, d
    bool is_well_scaled = true; ///< whether the filter applies (arithmetic.hpp)

    CameraRay() = default;
    /// Copies number by number, as wider loads would stall on the stores before them.
    explicit CameraRay(const scene::Ray& ray_in)
        : ray{{ray_in.origin.x, ray_in.origin.y, ray_in.origin.z},
              {ray_in.direction.x, ray_in.direction.y, ray_in.direction.z}},
          is_well_scaled{reference_rt::is_well_scaled(ray.origin) &&
                         reference_rt::is_well_scaled(ray.direction)}
    {
    }
};

/// (b − a) × (c − a).
template <typename Field>
[[nodiscard]] auto normal_of(const Corners& t)
{
    return cross(difference<Field>(t[1], t[0]), difference<Field>(t[2], t[0]));
}

using FilteredNormal = decltype(normal_of<FilterField>({}));

/// The ray-independent values of a triangle T = (a, b, c).
struct ExactTriangle : SceneTriangle {
    ExactTriangle() = default;
    explicit ExactTriangle(const SceneTriangle& own)
        : SceneTriangle{own},
          normal{normal_of<FilterField>(corners)}
    {
    }
    ExactTriangle(const scene::TriangleScene& scene, std::uint32_t index)
        : ExactTriangle{triangle_of(scene, index)}
    {
    }

    FilteredNormal normal{}; ///< n
};

/// ν of T's plane for rays from E: n·(a − E).
[[nodiscard]] inline Filtered<8> nu_of(const ExactTriangle& face, const scene::Vec3d& eye)
{
    return dot(face.normal, difference<FilterField>(face.corners[0], eye));
}

/// The ray parameter of T's plane, and a bound of its error, which is infinite if δ is too
/// uncertain.
struct PlaneDistance {
    double t = 0; ///< ν/δ
    double t_error = std::numeric_limits<double>::infinity();
};
[[nodiscard]] inline PlaneDistance plane_distance(const Filtered<7>& delta, const Filtered<8>& nu,
                                                  bool is_well_scaled)
{
    const double inverse = 1 / delta.value;
    const double t = nu.value * inverse;
    // |ν̂/δ̂ − ν/δ| <= (|ν̂ − ν| + |ν̂/δ̂||δ̂ − δ|)/|δ|, and |δ| >= 7/8 |δ̂|; the inverse and the
    // product round once each.
    const double error = 1.25 * std::abs(inverse) * (nu.error() + std::abs(t) * delta.error()) +
                         3 * unit_roundoff * std::abs(t);
    const bool is_known = std::abs(delta.value) > 8 * delta.error();
    return {t, (is_known & is_well_scaled) ? error : std::numeric_limits<double>::infinity()};
}

/// An exact point on a triangle (a, b, c): a + u(b − a) + v(c − a).
struct BarycentricPlace {
    double u = 0;
    double v = 0;
    bool is_well_scaled = true; ///< whether the filter applies (arithmetic.hpp)

    BarycentricPlace() = default;
    /// The corners need not be float32 values.
    BarycentricPlace(double u_in, double v_in, const Corners& corners)
        : u{u_in},
          v{v_in},
          is_well_scaled{reference_rt::is_well_scaled({u_in, v_in, 0}) &&
                         reference_rt::is_well_scaled(corners[0]) &&
                         reference_rt::is_well_scaled(corners[1]) &&
                         reference_rt::is_well_scaled(corners[2])}
    {
    }
};

/// A point P in the plane of a triangle T = (a, b, c), in one of two forms. Where a ray's line
/// meets the plane: P = E + (ν/δ)d with n = (b − a) × (c − a), δ = n·d, ν = n·(a − E), valid if δ
/// is not 0. Or at barycentric coordinates of T, with δ = 1.
struct Receiver {
    Receiver() = default;
    /// `face_in` and `ray_in` must outlive the receiver.
    Receiver(const ExactTriangle& face_in, const CameraRay& ray_in, SignCounts& counts)
        : Receiver{face_in, ray_in, nu_of(face_in, ray_in.ray.origin), counts}
    {
    }
    /// @param nu_in  ν, shared by all rays from one eye.
    Receiver(const ExactTriangle& face_in, const CameraRay& ray_in, const Filtered<8>& nu_in,
             SignCounts& counts)
        : face{&face_in},
          camera_ray{&ray_in},
          delta{dot(face->normal, vector<FilterField>(ray_in.ray.direction))},
          nu{nu_in}
    {
        const auto sign = filtered_sign(counts, is_well_scaled(), [&](auto) { return delta; });
        delta_sign = sign ? *sign : exact_delta_sign(counts);
        const PlaneDistance distance = plane_distance(delta, nu, is_well_scaled());
        t = distance.t;
        t_error = distance.t_error;
    }
    /// At barycentric coordinates. A point in space is a triangle whose corners all equal P, at (0,
    /// 0).
    Receiver(const ExactTriangle& face_in, const BarycentricPlace& place_in)
        : face{&face_in},
          place{&place_in},
          delta{1, 1},
          nu{0, 0},
          delta_sign{1}
    {
    }
    Receiver(const ExactTriangle&&, const BarycentricPlace&) = delete;
    Receiver(const ExactTriangle&, const BarycentricPlace&&) = delete;
    Receiver(const ExactTriangle&&, const CameraRay&, SignCounts&) = delete;
    Receiver(const ExactTriangle&, const CameraRay&&, SignCounts&) = delete;

    [[nodiscard]] std::uint32_t triangle() const { return face->triangle; }
    [[nodiscard]] const Corners& corners() const { return face->corners; }
    /// Precondition: P is given by a ray.
    [[nodiscard]] const scene::Ray& ray() const { return camera_ray->ray; }
    [[nodiscard]] bool is_well_scaled() const
    {
        return place != nullptr ? place->is_well_scaled : camera_ray->is_well_scaled;
    }

    /// P rounded [m]. Its error is that of t and a few roundings of E and t·d. Precondition: as
    /// `ray`.
    [[nodiscard]] scene::Vec3d point() const { return ray().origin + t * ray().direction; }

    const ExactTriangle* face = nullptr;     ///< T; not owned
    const CameraRay* camera_ray = nullptr;   ///< not owned; null if P has barycentric coordinates
    const BarycentricPlace* place = nullptr; ///< not owned; null if P is given by a ray
    Filtered<7> delta;
    Filtered<8> nu;
    Sign delta_sign = 0; ///< exact
    double t = 0;        ///< ν/δ
    /// Bound of the error of `t`; infinite if δ is too uncertain.
    double t_error = std::numeric_limits<double>::infinity();

private:
    [[nodiscard]] Sign exact_delta_sign(SignCounts& counts) const;
};

} // namespace gnomon::reference_rt
