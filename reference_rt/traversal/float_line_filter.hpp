#pragma once

#include "reference_rt/traversal/lane_rays.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "reference_rt/traversal/unit_frame.hpp"
#include "scene/camera/camera.hpp"
#include "scene/light/light.hpp"

#include <array>
#include <cstdint>
#include <limits>

/// Tests sixteen lines against one triangle in single precision with a proven error bound. It
/// settles nearly every candidate, and the exact predicates decide the rest.
namespace gnomon::reference_rt {

struct TrianglePlanes;
enum class LaneKind : std::uint8_t;

/// The lines through one point, or along one direction: the light's rays, or the camera's.
class RayBundle {
public:
    RayBundle(const UnitFrame& frame, const scene::Light& light);
    RayBundle(const UnitFrame& frame, const scene::Camera& camera);

private:
    friend TrianglePlanes make_planes(const UnitFrame&, const RayBundle&, const SceneTriangle&,
                                      LaneKind);

    bool is_parallel_ = false;
    scene::Vec3d direction_{}; ///< towards the bundle's point at infinity
    scene::Vec3d apex_{};      ///< the bundle's finite point [m]
    double scale_ = 1;         ///< scales apex − x to about 1 for every x in the scene
};

/// A float for each lane, as a compiler vector type: compiles to the widest available instructions,
/// and each lane rounds as a scalar float.
using LaneFloats [[gnu::vector_size(packet_size * sizeof(float))]] = float;

/// A point on each line, in the unit frame, or the lines' directions if they share a point. `reach`
/// bounds the point's error and the float rounding, per unit of a plane's normal.
struct LanePoints {
    LaneFloats x{}, y{}, z{}, reach{};

    /// @param error  of each component of `point` before rounding.
    void set(std::size_t lane, const scene::Vec3d& point, double error)
    {
        // The value of a plane at a lane's point is s = fl(N·p − k), with N, p and k rounded to
        // float32 and |x − o| <= 1 + |p| for the plane's corner o. With u = 2^-24 it is off by at
        // most |N|₁ times
        //     error + u|p|    the point,           u|p|        the normal,
        //     3u|p| + u       the sum, and k,      u(1 + |p|)  the last difference,
        // where |p| is the largest component; 8u(1 + |p|) is more than all but the first together.
        x[lane] = static_cast<float>(point.x);
        y[lane] = static_cast<float>(point.y);
        z[lane] = static_cast<float>(point.z);
        reach[lane] = reach_of(point, error);
    }
    /// All lanes.
    void set(const LanePositions& points);

private:
    [[nodiscard]] static float reach_of(const scene::Vec3d& point, double error)
    {
        constexpr double largest_judged = 0x1p100; // beyond this, products with normals overflow
        const double size = largest(point);
        const double reach = 1.01 * (error + 8 * float_roundoff * (1 + size));
        return static_cast<float>(size <= largest_judged ? reach
                                                         : std::numeric_limits<double>::infinity());
    }
};

/// A triangle's planes normal·x = offset with error bounds: through its edges and the bundle's
/// point, and its own.
struct TrianglePlanes {
    static constexpr std::size_t surface = 3;

    std::array<float, 4> x{}, y{}, z{}, offset{};
    std::array<float, 4> size{}; ///< |normal|₁ plus an allowance for the normal's error
    Sign towards = 0;            ///< side of the bundle's point of the surface if certain, or 0
};

/// Whether lines are tested by points, or by directions from the bundle's point, which lies in
/// every edge plane.
enum class LaneKind : std::uint8_t { points, directions };
[[nodiscard]] TrianglePlanes make_planes(const UnitFrame& frame, const RayBundle& ray_bundle,
                                         const SceneTriangle& s, LaneKind kind);

struct LineVerdicts {
    LaneBits inside = 0;  ///< the line certainly passes through the triangle's interior
    LaneBits outside = 0; ///< the line certainly misses the closed triangle
};

/// Tests each lane's line against the triangle's edge planes.
[[nodiscard]] LineVerdicts judge_lines(const LanePoints& points, const TrianglePlanes& planes);

/// Lanes whose point is certainly on the side `side` of the triangle's own plane.
[[nodiscard]] LaneBits certainly_on_side(const LanePoints& points, const TrianglePlanes& planes,
                                         Sign side);

} // namespace gnomon::reference_rt
