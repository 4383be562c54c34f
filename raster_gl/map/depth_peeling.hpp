#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <span>
#include <vector>

namespace gnomon::raster_gl {

/// Depth peeling: draws the nearest and second-nearest caster depth of each texel, beside the map
/// that lookups sample.
class DepthPeeling {
public:
    explicit DepthPeeling(const Context& context);

    /// @return  For each map an array of two layers of 32-bit depths, valid until the next call.
    ///          The second is the far plane where nothing lies behind the first.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    std::span<const Texture> render(const GpuScene& scene,
                                    std::span<const scene::LightFrustum> maps,
                                    const scene::ShadowMapSettings& settings);
    /// Frees the textures.
    void forget();

private:
    /// Draws casters behind the depths of `front`, or all of them if it is null, into `target`.
    void draw(const GpuScene& scene, const Texture* front, const Texture& target, bool reversed,
              int side_texels);

    const Context& context_;
    Program behind_;
    Framebuffer target_;
    std::vector<Texture> layers_; ///< by map
};

} // namespace gnomon::raster_gl
