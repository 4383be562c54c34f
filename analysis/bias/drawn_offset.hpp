#pragma once

#include "analysis/pixels/maps_of_pixels.hpp"
#include "analysis/pixels/quantiles.hpp"
#include "methods/polygon_offset.hpp"
#include "scene/depth/offset_unit.hpp"
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

/// How far casters are moved away from the light, over pixels; below 0 towards it.
struct OffsetLengths {
    Quantiles depth;  ///< depth units
    Quantiles metres; ///< along the light's axis [m]
    Quantiles texels; ///< those metres over the world width of a texel at the receiver
};

/// What a job's polygon offset is at its scored pixels: what the surface that a pixel shows is
/// moved by where it is drawn into the map, as it must be to not shadow itself.
struct DrawnOffset {
    methods::PolygonOffset offset; ///< the job's
    Quantiles r;                   ///< the driver's unit there [depth units]
    OffsetLengths of_factor;       ///< of factor · m alone
    OffsetLengths of_units;        ///< of units · r alone
    OffsetLengths whole;
};

/// What a triangle's window depth changes by per texel along u and v:
///
///     (g_u, g_v) = −(a, b)/c · 2/N · s,   (a, b, c, ·) = M^−T plane,   s = ½, clip range [0, 1]: 1
///
/// with M the map's float32 matrix, N its resolution. Not finite where the light sees it edge-on.
[[nodiscard]] scene::Vec2d depth_gradient(const scene::LightFrustum& map,
                                          const std::array<scene::Vec3f, 3>& corners,
                                          int resolution_texels);

/// m of a triangle: the largest change of its depth per texel, max(│g_u│, │g_v│), as GL allows and
/// Mesa has it (a driver that takes the root of both squares has up to √2 of it).
/// Source: OpenGL 4.6, 14.6.5.
[[nodiscard]] double largest_slope(const scene::LightFrustum& map,
                                   const std::array<scene::Vec3f, 3>& corners,
                                   int resolution_texels);

/// r at a depth: that of the measured depth nearest to it, of floats as many of the format's steps.
/// @param units  at least one.
[[nodiscard]] double offset_unit_at(std::span<const scene::OffsetUnit> units,
                                    scene::DepthFormat format, double depth);

/// The sum of an offset's parts, limited by its clamp.
/// @param of_factor  factor · m
/// @param r          the driver's unit
[[nodiscard]] double limited_sum(const methods::PolygonOffset& offset, double of_factor, double r);

/// All images are of one size, and outlive it.
struct DrawnOffsetInputs {
    const scene::TriangleScene& triangles;
    const scene::Image<std::uint32_t>& receivers; ///< the triangle that each pixel shows
    const scene::Image<scene::PixelClass>& classes;
    const scene::Image<float>& light_distance_m; ///< of the receivers [m]
    MapsOfPixels maps;
    scene::DepthFormat depth_format;
    std::span<const scene::OffsetUnit> units; ///< measured, at depths across [0, 1]; at least one
};

/// With m of `largest_slope`, and r of `offset_unit_at` at the receiver. Depths stay in [0, 1].
/// @return  Empty if no pixel is scored.
/// @throws std::invalid_argument  if no unit was measured.
/// Source: OpenGL 4.6, 14.6.5.
[[nodiscard]] std::optional<DrawnOffset> find_drawn_offset(const methods::PolygonOffset& offset,
                                                           const DrawnOffsetInputs& inputs);

} // namespace gnomon::analysis
