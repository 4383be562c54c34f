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

/// Draws the casters from the light twice: what each texel's centre sees first, and what it sees
/// first behind that (depth peeling). It stands beside the map that lookups sample.
class DepthPeeling {
public:
    explicit DepthPeeling(const Context& context);

    /// @return  Of each map an array of two layers of 32-bit depths, the object's own until the
    /// next
    ///          call; where nothing lies behind, the second is the far plane's.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    std::span<const Texture> render(const GpuScene& scene,
                                    std::span<const scene::LightFrustum> maps,
                                    const scene::ShadowMapSettings& settings);
    /// Gives the memory back.
    void forget();

private:
    /// Draws what lies behind the depths of `front`, or with nullptr everything, into `target`.
    void draw(const GpuScene& scene, const Texture* front, const Texture& target, bool reversed,
              int side_texels);

    const Context& context_;
    Program behind_;
    Framebuffer target_;
    std::vector<Texture> layers_; ///< by map
};

} // namespace gnomon::raster_gl
