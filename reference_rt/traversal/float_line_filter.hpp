#pragma once

#include "reference_rt/traversal/lane_rays.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "reference_rt/traversal/unit_frame.hpp"
#include "scene/camera/camera.hpp"
#include "scene/light/light.hpp"

#include <array>
#include <cstdint>
#include <limits>

/// A test of sixteen lines against one triangle in single precision, with a proven error bound: it
/// settles nearly every candidate of the traversal, and leaves the rest to the exact predicates.
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
    scene::Vec3d direction_{}; ///< towards the pencil's point at infinity
    scene::Vec3d apex_{};      ///< else the point [m]
    double scale_ = 1;         ///< makes apex − x about 1 for every x in the scene
};

/// A float for each lane. The compiler's vector type: it becomes the widest instructions there are,
/// and each lane rounds as a float alone does.
using LaneFloats [[gnu::vector_size(packet_size * sizeof(float))]] = float;

/// One point on each line, in the unit frame; or, for lines through a common point, their
/// directions. `reach` bounds how far the exact point may be from the stored one, and the rounding
/// in `float`, per unit of a plane's normal.
struct LanePoints {
    LaneFloats x{}, y{}, z{}, reach{};

    /// @param error  of each component of `point`, before it is rounded.
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
        constexpr double largest_judged = 0x1p100; // beyond it products with normals overflow
        const double size = largest(point);
        const double reach = 1.01 * (error + 8 * float_roundoff * (1 + size));
        return static_cast<float>(size <= largest_judged ? reach
                                                         : std::numeric_limits<double>::infinity());
    }
};

/// A triangle's planes normal·x = offset, with their largest errors: through its edges and the
/// pencil's point, and its own.
struct TrianglePlanes {
    static constexpr std::size_t surface = 3;

    std::array<float, 4> x{}, y{}, z{}, offset{};
    std::array<float, 4> size{}; ///< |normal|₁, and what covers the error of the normal
    Sign towards = 0;            ///< certain side of the pencil's point from the surface, or 0
};

/// Whether lines are judged by points, or by directions from the pencil's point, which lies in
/// every edge plane.
enum class LaneKind : std::uint8_t { points, directions };
[[nodiscard]] TrianglePlanes make_planes(const UnitFrame& frame, const RayBundle& ray_bundle,
                                         const SceneTriangle& s, LaneKind kind);

struct LineVerdicts {
    LaneBits inside = 0;  ///< the line certainly passes through the triangle's interior
    LaneBits outside = 0; ///< the line certainly misses the closed triangle
};

/// Judges each lane's line of the pencil by the triangle's edge planes.
[[nodiscard]] LineVerdicts judge_lines(const LanePoints& points, const TrianglePlanes& planes);

/// Lanes whose point is certainly on the side `side` of the triangle's own plane.
[[nodiscard]] LaneBits certainly_on_side(const LanePoints& points, const TrianglePlanes& planes,
                                         Sign side);

} // namespace gnomon::reference_rt
