#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/receivers.hpp"
#include "raster_gl/shadow_map.hpp"
#include "scene/job/job.hpp"
#include "scene/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <compare>
#include <map>

namespace gnomon::raster_gl {

/// Looks every receiver up in the shadow map.
///
/// The bias is a uniform, and r, d and tan θ are handed out: constant and slope bias can be changed
/// afterwards without GL.
class LookupPass {
public:
    explicit LookupPass(const Context& context);

    /// Draws the lookup; read the result with `read`.
    /// @throws std::invalid_argument  if the receivers are not of the view's size.
    void render(const GpuScene& scene, const ReceiverBuffer& receivers, const ShadowMap& map,
                const scene::LookupSettings& settings, const scene::View& view);

    /// What `render` drew last, in images of the view's size, top left first.
    [[nodiscard]] scene::LookupLayers read() const;

    /// The smallest constant bias of each pixel with which `render`'s verdict is at least one half,
    /// with the view's slope and normal offset: found by trying, in one draw, so that it holds
    /// whatever the driver's arithmetic is, as long as the verdict rises with the bias.
    /// @return  0 or a normal float32; −∞ if every bias is lit, +∞ if none is; 0 without a
    ///          receiver. Top left first.
    /// @throws std::invalid_argument  as `render`.
    /// Source: docs/bias_curve.md#bisection.
    [[nodiscard]] scene::Image<float> find_critical_biases(const GpuScene& scene,
                                                           const ReceiverBuffer& receivers,
                                                           const ShadowMap& map,
                                                           const scene::LookupSettings& settings,
                                                           const scene::View& view);

private:
    struct Variant {
        scene::Filter filter = scene::Filter::nearest;
        scene::Outside outside = scene::Outside::lit;
        bool reversed = false;
        bool spot = false;
        scene::LookupPosition position = scene::LookupPosition::vertex;
        bool bisects = false; ///< finds critical biases

        auto operator<=>(const Variant&) const = default;
    };
    const Program& program(const Variant& variant);
    void allocate(scene::ImageSize size);
    /// Draws to the bound framebuffer.
    void draw(const GpuScene& scene, const ReceiverBuffer& receivers, const ShadowMap& map,
              const scene::LookupSettings& settings, const scene::View& view, bool bisects);
    void bind_map(const ShadowMap& map, const scene::LookupSettings& settings) const;

    const Context& context_;
    std::map<Variant, Program> programs_;
    VertexArray no_attributes_;
    Sampler map_sampler_;
    Sampler compare_sampler_;
    Framebuffer target_;
    Texture samples_;
    Texture texels_;
    scene::ImageSize size_{0, 0};
};

} // namespace gnomon::raster_gl
