#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/truth.hpp"
#include "renderers/values.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <array>
#include <cstdint>

namespace gnomon::reference_rt {

/// The limits of GL's receiver pass: its sub-pixel grid and its depth buffer.
class ReceiverRaster {
public:
    /// All arguments except `box` must outlive this object.
    ReceiverRaster(const scene::TriangleScene& triangles, const scene::View& view,
                   const scene::Box& box, const renderers::RasterFacts& facts);

    /// Whether GL's coverage of pixel (x, y)'s centre may differ from exact coverage, as GL snaps
    /// corners to its sub-pixel grid.
    ///
    /// Decides from GL's own clip positions: moving corners by ±1 sub-pixel may put the centre on
    /// either side of an edge, or certainly changes the coverage. For a clipped triangle, the
    /// centre lies within one sub-pixel of an edge's homogeneous line, or the lines change the
    /// coverage; the cuts with the near and far planes count as edges. Allows for float32 rounding
    /// in GL's clipper, and in its transform if its positions are unknown.
    /// @param is_covered  exact coverage of the centre by the closed triangle.
    [[nodiscard]] bool coverage_may_differ(std::uint32_t triangle, int x, int y,
                                           bool is_covered) const;

    /// Whether GL's depth buffer may fail to put `nearer` before `farther` at pixel (x, y), by the
    /// planes through GL's clip positions and their driver bounds.
    [[nodiscard]] bool is_tie(std::uint32_t nearer, std::uint32_t farther, int x, int y) const;

private:
    /// A homogeneous window-space corner relative to a pixel's centre.
    struct Corner {
        scene::Vec3d position; ///< ((X − centre.x)w, (Y − centre.y)w, w), X and Y in pixels
        scene::Vec3d error{};  ///< of GL's float32 transform, unless known, and of its clipper
        scene::Vec4d clip;
        double depth_error = 0; ///< of clip.z, likewise
    };
    using WindowCorners = std::array<Corner, 3>;
    /// Window depth at a pixel's centre, reversed: 1 at the near plane.
    struct Depth {
        double value = 0;
        double error = 0; ///< error bound of the depth that GL stores
    };
    [[nodiscard]] static bool is_clipped(const WindowCorners& corners);
    [[nodiscard]] WindowCorners window_corners(std::uint32_t triangle, int x, int y) const;
    /// Whether a pixel's centre is inside a boundary, within GL's precision.
    enum class Side : std::uint8_t { inside, unsure, outside };
    [[nodiscard]] Side side_of_clip_planes(const WindowCorners& corners, int x, int y) const;
    [[nodiscard]] Depth depth(std::uint32_t triangle, int x, int y) const;
    [[nodiscard]] double vertex_error(std::uint32_t triangle, const WindowCorners& corners) const;
    [[nodiscard]] bool is_near_line(const WindowCorners& corners) const;
    [[nodiscard]] bool is_near_boundary(const WindowCorners& corners) const;

    const scene::TriangleScene& triangles_;
    const renderers::RasterFacts& facts_;
    scene::ImageSize image_;
    scene::Mat4f clip_from_world_;
};

} // namespace gnomon::reference_rt
