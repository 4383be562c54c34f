#pragma once

#include "reference_rt/packet.hpp"
#include "reference_rt/unit_frame.hpp"
#include "scene/camera.hpp"
#include "scene/light.hpp"

#include <array>
#include <cstdint>

/// A test of sixteen lines against one triangle in single precision, with a proven error bound: it
/// settles nearly every candidate of the traversal, and leaves the rest to the exact predicates.
namespace gnomon::reference_rt {

/// The lines through one point, or along one direction: the light's rays, or the camera's.
class Pencil {
public:
    Pencil(const UnitFrame& frame, const scene::Light& light);
    Pencil(const UnitFrame& frame, const scene::Camera& camera);

    /// From x towards the pencil's point, scaled by a positive constant; at most about 4.
    [[nodiscard]] scene::Vec3d towards(const scene::Vec3d& x) const
    {
        return is_parallel_ ? direction_ : scale_ * (apex_ - x);
    }

private:
    bool is_parallel_ = false;
    scene::Vec3d direction_{};
    scene::Vec3d apex_{};
    double scale_ = 1;
};

/// One point on each line, in the unit frame; or, for lines through a common point, their
/// directions. `reach` bounds how far the exact point may be from the stored one, and the rounding
/// in `float`, per unit of a plane's normal.
struct alignas(64) LanePoints {
    PacketOf<float> x{}, y{}, z{}, reach{};

    /// @param error  of each component of `point`, before it is rounded.
    void set(std::size_t lane, const scene::Vec3d& point, double error);
};

/// The plane normal·x = offset; `size` bounds |normal|₁ with its own error.
struct Plane {
    float x = 0, y = 0, z = 0, offset = 0, size = 0;
};

/// The planes through a triangle's edges that contain the pencil's point.
struct EdgePlanes {
    std::array<Plane, 3> edge;
};

/// A triangle's planes as a shadow ray needs them.
struct ShadowPlanes {
    EdgePlanes edges;
    Plane surface;
    Sign light = 0; ///< certain side of the light from the triangle's plane, or 0
};

struct LineVerdicts {
    LaneBits inside = 0;  ///< the line certainly passes through the triangle's interior
    LaneBits outside = 0; ///< the line certainly misses the closed triangle
};

/// @param has_apex_at_origin  lanes are directions from the pencil's point, so every offset is 0.
[[nodiscard]] EdgePlanes edge_planes(const UnitFrame& frame, const Pencil& pencil,
                                     const Corners& corners, bool has_apex_at_origin);
[[nodiscard]] ShadowPlanes shadow_planes(const UnitFrame& frame, const Pencil& pencil,
                                         const Corners& corners);

[[nodiscard]] LineVerdicts judge_lines(const LanePoints& points, const EdgePlanes& planes);

/// Lanes whose point is certainly on the side `side` of the plane.
[[nodiscard]] LaneBits certainly_on_side(const LanePoints& points, const Plane& plane, Sign side);

} // namespace gnomon::reference_rt
