#pragma once

#include "scene/depth/driver_bound.hpp"
#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

#include <array>

namespace gnomon::scene {

/// The exact distance to the light, over far, of a triangle as GL rasterises it: of its float32
/// vertices, interpolated between its float32 clip positions.
class RasterDistance {
public:
    /// @param corners  in the world
    /// @param clip     GL's clip positions of the corners
    /// @param window   the same in the window; its depths do not matter
    /// @param light    a perspective
    RasterDistance(const std::array<Vec3f, 3>& corners, const std::array<Vec4f, 3>& clip,
                   const WindowTriangle& window, const LightFrustum& light);

    /// At a point of the window, counted from its lower left.
    [[nodiscard]] double over_far(const Vec2d& at_px) const;
    /// Bound on |GL's value − `over_far`| before the format rounds.
    ///
    /// GL interpolates x/w, y/w, z/w and 1/w, each linear in the window and off by what
    /// `driver_depth_bound` says of such a plane, B_c and B_w. The quotient errs by
    /// (B_c + |P_c|·B_w)·w + 4u|P_c|, the difference to the light by u more; along the direction to
    /// the light that is the distance's error. Length and division are left 16u of it, u = 2^-24.
    /// Source: docs/depth_precision.md#distances.
    [[nodiscard]] double driver_bound(const Vec2d& at_px, int subpixel_bits) const;

private:
    [[nodiscard]] Vec3d position_m(const Vec2d& at_px) const;

    std::array<WindowTriangle, 3> position_over_w_; ///< x/w, y/w, z/w in place of depths
    WindowTriangle inverse_w_;                      ///< 1/w
    Vec3d light_;                                   ///< as GL has it
    double far_m_;                                  ///< as GL has it
};

} // namespace gnomon::scene
