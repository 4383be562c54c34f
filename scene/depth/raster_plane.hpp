#pragma once

#include "scene/depth/driver_bound.hpp"
#include "scene/light/depth_range.hpp"
#include "scene/vec.hpp"

#include <array>
#include <optional>

namespace gnomon::scene {

/// What is linear in the window, between a triangle's corners, at a point of the window.
[[nodiscard]] double interpolated(const WindowTriangle& triangle, const Vec2d& at_px);

/// The exact depth of a triangle as GL rasterises it: the plane through its float32 clip positions.
class RasterPlane {
public:
    /// @param clip               GL's clip positions of the corners.
    /// @param resolution_texels  side of the square map.
    RasterPlane(const std::array<Vec4f, 3>& clip, int resolution_texels, ClipRange range);

    /// Whether GL need not clip it against near or far, and it has an area.
    [[nodiscard]] bool is_whole() const { return is_whole_; }
    /// Distance of a point of the window to the nearest edge [px], positive inside.
    [[nodiscard]] double inside_px(const Vec2d& at_px) const;
    /// Exact window depth at a point of the window, counted from its lower left.
    [[nodiscard]] double depth(const Vec2d& at_px) const;
    /// Bound on |GL's depth − `depth`| before the format rounds: `driver_depth_bound` with the
    /// corners' division and viewport as B_vert. No driver says whether depth follows the snapped
    /// corners, so the bound assumes that it does.
    [[nodiscard]] double driver_bound(const Vec2d& at_px, int subpixel_bits) const;
    /// The corners in the window.
    [[nodiscard]] const WindowTriangle& window() const { return window_; }

private:
    WindowTriangle window_{};
    double area2_px2_ = 0; ///< signed
    double corner_error_ = 0;
    bool is_whole_ = false;
};

} // namespace gnomon::scene
