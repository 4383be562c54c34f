#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/truth.hpp"
#include "renderers/values.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <array>
#include <cstdint>

namespace gnomon::reference_rt {

/// What GL's receiver pass can and cannot resolve: its sub-pixel grid and its depth buffer.
class ReceiverRaster {
public:
    /// All but `box` must outlive it.
    ReceiverRaster(const scene::TriangleScene& triangles, const scene::View& view,
                   const scene::Box& box, const renderers::RasterFacts& facts);

    /// True when GL, which snaps corners to its sub-pixel grid, may judge the coverage of pixel
    /// (x, y)'s centre otherwise than exact geometry does.
    ///
    /// From GL's own clip positions: corners that move by ±1 sub-pixel may put the centre on either
    /// side of an edge, or they certainly decide otherwise. For a triangle that GL clips: the
    /// centre lies within one sub-pixel of an edge's homogeneous line, or the lines decide
    /// otherwise; the line in which the near or far plane cuts it is an edge as well. What GL
    /// rounds in float32 is allowed for: in its clipper, and in its transform where its positions
    /// are not known.
    /// @param is_covered  whether the closed triangle covers the centre, exactly.
    [[nodiscard]] bool coverage_may_differ(std::uint32_t triangle, int x, int y,
                                           bool is_covered) const;

    /// True when GL's depth buffer does not certainly put `nearer` before `farther` at pixel (x,
    /// y): by the planes through GL's own clip positions, and the driver bound of each.
    [[nodiscard]] bool is_tie(std::uint32_t nearer, std::uint32_t farther, int x, int y) const;

private:
    /// A corner in window space, homogeneous, seen from a pixel's centre.
    struct Corner {
        scene::Vec3d position; ///< ((X − centre.x)w, (Y − centre.y)w, w), X and Y in pixels
        scene::Vec3d error{};  ///< of GL's float32 transform, if unknown, and of its clipper
        scene::Vec4d clip;
        double depth_error = 0; ///< of clip.z, likewise
    };
    using WindowCorners = std::array<Corner, 3>;
    /// Window depth at a pixel's centre, reversed: 1 at the near plane.
    struct Depth {
        double value = 0;
        double error = 0; ///< of what GL stores
    };
    [[nodiscard]] static bool is_clipped(const WindowCorners& corners);
    [[nodiscard]] WindowCorners window_corners(std::uint32_t triangle, int x, int y) const;
    /// Whether a pixel's centre is inside of something that GL decides from positions.
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
