#pragma once

#include "analysis/pixels/maps_of_pixels.hpp"
#include "analysis/pixels/statistics.hpp"
#include "methods/polygon_offset.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::analysis {

/// How far an offset moves casters away from the light, over pixels; negative towards it.
struct OffsetLengths {
    Quantiles depth;  ///< depth units
    Quantiles metres; ///< along the light's axis [m]
    Quantiles texels; ///< those metres in world-space texel widths at the receiver
};

/// The effect of a job's polygon offset at its scored pixels: how far it moves the surface that a
/// pixel shows when it is drawn into the map.
struct DrawnOffset {
    methods::PolygonOffset offset; ///< the job's
    Quantiles r;                   ///< the driver's unit there [depth units]
    OffsetLengths of_factor;       ///< of factor · m alone
    OffsetLengths of_units;        ///< of units · r alone
    OffsetLengths whole;
};

/// Change of a triangle's window depth per texel along u and v:
///
///     (g_u, g_v) = −(a, b)/c · 2/N · s,   (a, b, c, ·) = M^−T plane,   s = ½, clip range [0, 1]: 1
///
/// with M the map's float32 matrix and N its resolution. Not finite if the light sees the triangle
/// edge-on.
[[nodiscard]] scene::Vec2d depth_gradient(const scene::LightFrustum& map,
                                          const std::array<scene::Vec3f, 3>& corners,
                                          int resolution_texels);

/// m of a triangle: the largest change of its depth per texel, max(│g_u│, │g_v│). GL allows this,
/// and Mesa computes it. A driver that takes the root of the sum of squares has up to √2 of it.
/// Source: OpenGL 4.6, 14.6.5.
[[nodiscard]] double largest_slope(const scene::LightFrustum& map,
                                   const std::array<scene::Vec3f, 3>& corners,
                                   int resolution_texels);

/// r at a depth: the unit measured at the nearest depth; for floats, that many of the format's
/// steps here.
/// @param units  At least one.
[[nodiscard]] double offset_unit_at(std::span<const scene::OffsetUnit> units,
                                    scene::DepthFormat format, double depth);

/// The sum of an offset's two parts, limited by its clamp.
/// @param of_factor  factor · m
/// @param r          The driver's unit.
[[nodiscard]] double limited_sum(const methods::PolygonOffset& offset, double of_factor, double r);

/// All images have one size and must stay alive.
struct DrawnOffsetInputs {
    const scene::TriangleScene& triangles;
    const scene::Image<std::uint32_t>& receivers; ///< the triangle that each pixel shows
    const scene::Image<scene::PixelClass>& classes;
    const scene::Image<float>& light_distance_m; ///< of the receivers [m]
    MapsOfPixels maps;
    scene::DepthFormat depth_format;
    std::span<const scene::OffsetUnit> units; ///< measured, at depths across [0, 1]; at least one
};

/// The drawn offset, with m from `largest_slope` and r from `offset_unit_at` at the receiver.
/// Depths stay in [0, 1].
/// @return  Empty if no pixel is scored.
/// @throws std::invalid_argument  if no unit was measured.
/// Source: OpenGL 4.6, 14.6.5.
[[nodiscard]] std::optional<DrawnOffset> find_drawn_offset(const methods::PolygonOffset& offset,
                                                           const DrawnOffsetInputs& inputs);

} // namespace gnomon::analysis
