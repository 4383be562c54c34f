#pragma once

#include "scene/vec.hpp"

#include <array>

namespace gnomon::scene {

/// A triangle in window space as GL rasterises it.
struct WindowTriangle {
    std::array<Vec2d, 3> position_px; ///< window x, y [px], before snapping
    std::array<double, 3> depth;      ///< window depth of each corner
};

/// Facts of the rasteriser that the bound depends on.
struct RasterModel {
    int subpixel_bits = 8;
    bool interpolates_from_snapped = false; ///< D3D-style hardware; llvmpipe does not
};

/// Largest |stored − exact| depth of a window-space triangle at a pixel centre, before the format
/// rounds, for depth planes evaluated in float32 (window depth units).
///
///     B = B_vert + 2^-(s+1)(|z_x| + |z_y|)·[snapped] + B_plane
///     B_plane = 6·2^-24 (|z0| + 2(|z_x|X + |z_y|Y)) + cancellation + edge rounding
///
/// @param triangle      the corners from the float32 clip positions.
/// @param vertex_error  B_vert: bound on the corners' own depth error (transform and division).
/// @param centre_px     the pixel or texel centre.
/// @return  Window depth, >= 0; infinite without an area, and for slivers too thin to be bounded.
/// Source: docs/formulas.md#driver-bound; Mesa llvmpipe's lp_state_setup.c evaluates the plane from
/// the framebuffer's origin, hence X and Y, the triangle's largest window coordinates.
[[nodiscard]] double driver_depth_bound(const WindowTriangle& triangle, const RasterModel& model,
                                        double vertex_error, const Vec2d& centre_px);

/// B_vert: bound on the window depth error of a vertex transformed in float32 by `clip_from_world`
/// and divided by w: e = (γ4·S_z + |z/w|·γ4·S_w)/|w| + 2u|z/w|, and e/2 + u for the clip range
/// [−1, 1], where S is the row's sum of absolute products and γ4 = 4u/(1−4u), u = 2^-24. Relative
/// to z for [0, 1], so that it serves the small depths of reversed z; infinite for w = 0.
[[nodiscard]] double vertex_depth_error(const Mat4f& clip_from_world, const Vec3f& vertex,
                                        bool zero_to_one);

} // namespace gnomon::scene
