#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/shadow_map.hpp"
#include "scene/depth/measured_planes.hpp"
#include "scene/depth/raster_distance.hpp"
#include "scene/depth/raster_plane.hpp"
#include "scene/depth/sample.hpp"

#include <vector>

namespace gnomon::raster_gl {

/// Draws depth planes and says what GL stored of them, beside the exact depths.
class RasterPlanes {
public:
    /// @param context, planes  must outlive it.
    /// @throws scene::EnvironmentError  if GL fails.
    RasterPlanes(const Context& context, const scene::MeasuredPlanes& planes);

    /// Draws them in one map and reads one texel of each plane; planes that float32 moved off their
    /// texel, or over that of another, are missing.
    /// @throws scene::InputError  if the driver lacks the format or the map's size, or float32
    ///                            moves the planes all over each other.
    [[nodiscard]] scene::DepthMeasurement measure(scene::DepthFormat format);
    /// Draws them in one map and reads every texel whose centre a triangle covers with certainty.
    /// @throws scene::InputError  if the driver lacks the format or the map's size.
    [[nodiscard]] std::vector<scene::TexelDepth> read_all(scene::DepthFormat format);

private:
    void include_triangle(std::size_t triangle, const scene::Image<std::uint32_t>& codes,
                          std::vector<scene::TexelDepth>& texels) const;
    /// What GL should have stored of a triangle at a point of the window.
    [[nodiscard]] scene::TexelDepth texel_depth(std::size_t triangle, const scene::Vec2d& at,
                                                std::uint32_t code) const;
    /// By sample: whether the triangle of another may cover its texel.
    [[nodiscard]] std::vector<bool> disputed_samples() const;
    [[nodiscard]] bool surely_covers(const scene::RasterPlane& plane, const scene::Vec2d& at) const;
    const ShadowMap& draw(scene::DepthFormat format);

    const Context& context_;
    const scene::MeasuredPlanes& planes_;
    GpuScene gpu_;
    ShadowMapPass pass_;
    std::vector<scene::RasterPlane> raster_;       ///< by triangle
    std::vector<scene::RasterDistance> distances_; ///< the same, where the map has distances
    int subpixel_bits_;
};

} // namespace gnomon::raster_gl
