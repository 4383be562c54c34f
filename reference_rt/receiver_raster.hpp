#pragma once

#include "reference_rt/double_predicates.hpp"
#include "reference_rt/truth.hpp"
#include "scene/camera.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <array>

namespace gnomon::reference_rt {

/// What GL's receiver pass can and cannot resolve: its sub-pixel grid and its depth buffer.
class ReceiverRaster {
public:
    ReceiverRaster(const scene::Camera& camera, scene::ImageSize image, const scene::Box& box,
                   const RasterFacts& facts);

    /// True when snapping and the float32 vertex transform may decide whether the triangle covers
    /// the centre of pixel (x, y): the centre lies within one sub-pixel, and the transform's error,
    /// of one of its edges' lines.
    [[nodiscard]] bool is_near_edge(const Corners& triangle, int x, int y) const;

    /// Bound on the error of the depth stored for the triangle at pixel (x, y), in [0, 1] units.
    ///
    /// The driver bound; for a triangle that reaches behind the camera, whose clipped corners are
    /// not known here, the same with the whole window's extent and depth 1 in their place.
    [[nodiscard]] double depth_error(const Corners& triangle, int x, int y) const;

    /// Window depth of a world point: reversed, 1 at the near plane.
    [[nodiscard]] double depth(const scene::Vec3d& point) const;

private:
    /// A corner in window space, homogeneous, seen from a pixel's centre.
    struct Corner {
        scene::Vec3d position; ///< ((X − centre.x)w, (Y − centre.y)w, w), X and Y in pixels
        scene::Vec3d error;    ///< bounds of the float32 transform's error
        double clip_depth = 0; ///< z before the division
    };
    [[nodiscard]] std::array<Corner, 3> window_corners(const Corners& triangle, int x, int y) const;

    scene::Mat4d clip_from_world_;
    scene::Mat4f clip_from_world_float_;
    scene::ImageSize image_;
    RasterFacts facts_;
};

} // namespace gnomon::reference_rt
