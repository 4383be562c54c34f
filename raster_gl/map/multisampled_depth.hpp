#pragma once

#include "methods/polygon_offset.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"

#include <optional>
#include <span>
#include <vector>

namespace gnomon::raster_gl {

/// Draws a multisampled depth map of the casters, beside the map of texel centres.
class MultisampledDepth {
public:
    explicit MultisampledDepth(const Context& context);

    /// @param samples  per texel; at least 2.
    /// @return  A multisampled depth texture for each map, valid until the next call.
    /// @throws std::invalid_argument    for a colour format.
    /// @throws scene::InputError        if the driver does not support exactly this many samples.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    std::span<const Texture> render(const GpuScene& scene,
                                    std::span<const scene::LightFrustum> maps,
                                    const scene::ShadowMapSettings& settings, int samples,
                                    const std::optional<methods::PolygonOffset>& offset = {});
    /// Sample positions in a texel, from its lower left [texels].
    /// @throws scene::InputError  as `render`.
    [[nodiscard]] std::vector<scene::Vec2d> places(int samples);
    /// Frees the textures.
    void forget();

private:
    void require_samples(int samples) const;
    [[nodiscard]] Texture make_depths(const scene::ShadowMapSettings& settings, int samples) const;

    const Context& context_;
    Program depth_only_;
    Program unorm_;
    Framebuffer target_;
    std::vector<Texture> depths_; ///< by map
};

} // namespace gnomon::raster_gl
