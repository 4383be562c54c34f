#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/map/shadow_map.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/depth/measured_planes.hpp"
#include "scene/depth/raster_plane.hpp"
#include "scene/settings/job.hpp"

#include <vector>

namespace gnomon::raster_gl {

/// Draws depth planes, and pairs the depths that GL stored with the exact ones.
class RasterPlanes {
public:
    /// @param context, planes  must outlive this object.
    /// @throws scene::EnvironmentError  if GL fails.
    RasterPlanes(const Context& context, const scene::MeasuredPlanes& planes);

    /// Draws the planes into one map and reads one texel of each. Planes that float32 rounding
    /// moved off their texel, or over another's, are missing.
    /// @throws scene::InputError  if the driver lacks the format or the map's size, or float32
    ///                            rounding moves the planes over each other.
    [[nodiscard]] scene::DepthMeasurement measure(scene::DepthFormat format);
    /// Draws the planes into one map and reads every texel whose centre a triangle certainly
    /// covers.
    /// @throws scene::InputError  if the driver lacks the format or the map's size.
    [[nodiscard]] std::vector<scene::TexelDepth> read_all(scene::DepthFormat format);

private:
    void include_triangle(std::size_t triangle, const scene::Image<std::uint32_t>& codes,
                          std::vector<scene::TexelDepth>& texels) const;
    /// The depth that GL should have stored for a triangle at a window position.
    [[nodiscard]] scene::TexelDepth texel_depth(std::size_t triangle, const scene::Vec2d& at,
                                                std::uint32_t code) const;
    /// For each sample, whether another plane's triangle may cover its texel.
    [[nodiscard]] std::vector<bool> disputed_samples() const;
    [[nodiscard]] bool surely_covers(const scene::RasterPlane& plane, const scene::Vec2d& at) const;
    const ShadowMap& draw(scene::DepthFormat format);

    const Context& context_;
    const scene::MeasuredPlanes& planes_;
    GpuScene gpu_;
    ShadowMapPass pass_;
    std::vector<scene::RasterPlane> raster_;       ///< by triangle
    std::vector<scene::RasterDistance> distances_; ///< by triangle, if the map stores distances
    int subpixel_bits_;
};

/// Measures r, the unit of polygon offset, at depths across [0, 1]: draws flat planes with an
/// offset of many units and reads how far they shift.
///
/// GL leaves r to the driver: the smallest difference that is sure to change the stored value. For
/// float formats it depends on the triangle's largest depth.
/// @throws scene::InputError        if the driver lacks the format.
/// @throws scene::EnvironmentError  if GL fails.
/// Source: OpenGL 4.6, 14.6.5.
[[nodiscard]] std::vector<scene::OffsetUnit> measure_offset_units(const Context& context,
                                                                  scene::DepthFormat format);

} // namespace gnomon::raster_gl
