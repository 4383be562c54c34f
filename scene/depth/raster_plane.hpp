#pragma once

#include "scene/depth/driver_bound.hpp"
#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

#include <array>
#include <optional>

namespace gnomon::scene {

/// Interpolates the corners' depths, linearly in the window, at a point of the window.
[[nodiscard]] double interpolated(const WindowTriangle& triangle, const Vec2d& at_px);

/// The exact depth of a triangle as GL rasterises it: the plane through its float32 clip positions.
class RasterPlane {
public:
    /// @param clip               GL's clip positions of the corners.
    /// @param resolution_texels  side of the square map.
    RasterPlane(const std::array<Vec4f, 3>& clip, int resolution_texels, ClipRange range);

    /// Whether it lies between near and far and has an area.
    [[nodiscard]] bool is_whole() const { return is_whole_; }
    /// Distance of a point of the window to the nearest edge [px], positive inside.
    [[nodiscard]] double inside_px(const Vec2d& at_px) const;
    /// Exact window depth at a point of the window, counted from its lower left.
    [[nodiscard]] double depth(const Vec2d& at_px) const;
    /// Bound on |GL's depth − `depth`| before the format rounds: `driver_depth_bound` with the
    /// corners' division and viewport as B_vert. Drivers do not say whether depth follows the
    /// snapped corners, so the bound assumes that it does.
    [[nodiscard]] double driver_bound(const Vec2d& at_px, int subpixel_bits) const;
    /// The corners in the window.
    [[nodiscard]] const WindowTriangle& window() const { return window_; }

private:
    WindowTriangle window_{};
    double area2_px2_ = 0; ///< signed
    double corner_error_ = 0;
    bool is_whole_ = false;
};

/// The exact distance to the light over far of a triangle as GL rasterises it: its float32
/// vertices, interpolated between its float32 clip positions.
class RasterDistance {
public:
    /// @param corners  in the world
    /// @param clip     GL's clip positions of the corners
    /// @param window   the corners in the window; depths are ignored
    /// @param light    a perspective
    RasterDistance(const std::array<Vec3f, 3>& corners, const std::array<Vec4f, 3>& clip,
                   const WindowTriangle& window, const LightFrustum& light);

    /// At a point of the window, counted from its lower left.
    [[nodiscard]] double over_far(const Vec2d& at_px) const;
    /// Bound on |GL's value − `over_far`| before the format rounds.
    ///
    /// GL interpolates x/w, y/w, z/w and 1/w. Each is linear in the window, with the errors B_c and
    /// B_w of `driver_depth_bound`. The quotient errs by (B_c + |P_c|·B_w)·w + 4u|P_c|, the
    /// difference to the light by u more; its part along the direction to the light is the
    /// distance's error. Length and division may err by another 16u of the distance, u = 2^-24.
    /// Source: docs/depth_precision.md#distances.
    [[nodiscard]] double driver_bound(const Vec2d& at_px, int subpixel_bits) const;

private:
    [[nodiscard]] Vec3d position_m(const Vec2d& at_px) const;

    std::array<WindowTriangle, 3> position_over_w_; ///< x/w, y/w, z/w in place of depths
    WindowTriangle inverse_w_;                      ///< 1/w
    Vec3d light_;                                   ///< as GL receives it
    double far_m_;                                  ///< as GL receives it
};

} // namespace gnomon::scene
