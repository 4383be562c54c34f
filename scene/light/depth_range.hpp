#pragma once

#include "scene/camera/camera.hpp"
#include "scene/vec.hpp"

#include <cstdint>

namespace gnomon::scene {

/// The range of z_ndc between near and far: GL's own, or that of glClipControl(…, GL_ZERO_TO_ONE).
enum class ClipRange : std::uint8_t { minus_one_to_one, zero_to_one };

/// How a projection maps the distance ζ from the camera's plane to depth.
struct DepthRange {
    Projection projection = Projection::perspective;
    double near_m = 0.1;
    double far_m = 100;
    bool reversed = false; ///< near at depth 1, far at 0
    ClipRange clip_range = ClipRange::minus_one_to_one;

    /// What one depth unit spans [m]; of an orthographic projection everywhere.
    [[nodiscard]] double range_m() const { return far_m - near_m; }
};

/// The projection's z row as a linear function of ζ: z_clip = x·ζ + y.
///
/// w is ζ for a perspective, 1 for an orthographic projection.
/// Source: docs/depth_precision.md#depth-of-a-distance.
[[nodiscard]] Vec2d clip_depth_row(const DepthRange& range);

} // namespace gnomon::scene
