#pragma once

#include "methods/bias_term.hpp"
#include "methods/passes.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/layered_texture.hpp"
#include "raster_gl/receivers.hpp"
#include "raster_gl/shadow_map.hpp"
#include "renderers/rasterizer.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace gnomon::raster_gl {

/// What is looked up, and where.
struct LookedUp {
    const GpuScene& scene;
    const ReceiverBuffer& receivers;
    const ShadowMap& map;
    const LayeredTexture* filtered =
        nullptr; ///< what a prefilter made of the map; nullptr: nothing
};

/// What a bisection looks for.
struct Bisection {
    float lit_from = 0.5F; ///< the least verdict that is enough
    renderers::ReceiverDepths receiver_depths;
};

/// Looks every receiver up in the shadow map, or in what a method made of it; of several maps in
/// the one that it reads (`scene::MapChoice`).
///
/// The bias terms of the method act as the view's bias says. Biases are uniforms, and r, d and tan
/// θ are handed out, r as it is compared before constant and slope: these two can be changed
/// afterwards without GL.
class LookupPass {
public:
    explicit LookupPass(const Context& context);

    /// Draws the lookup; read the result with `read`.
    /// @throws std::invalid_argument  if the receivers are not of the view's size, there are not
    ///                                as many maps as the view has, or several are looked up from
    ///                                vertices.
    void render(const LookedUp& from, const scene::Job& job, const scene::View& view,
                const renderers::ReceiverDepths& receiver_depths = {});

    /// What `render` drew last, in images of the view's size, top left first. Shares of equal taps
    /// are the float32 next to them: the shader's division may miss it (GLSL 4.5, 4.7.1: 2.5 ulp).
    [[nodiscard]] scene::LookupLayers read() const;

    /// The smallest constant bias of each pixel with which `render`'s verdict is at least one half,
    /// or what else is asked, with the view's other biases: found by trying, in one
    /// draw, so that it holds whatever the driver's arithmetic is, as long as the verdict rises
    /// with the bias.
    /// @return  0 or a normal float32; −∞ if every bias is lit, +∞ if none is; 0 without a
    ///          receiver. Top left first.
    /// @throws std::invalid_argument  as `render`.
    /// Source: docs/bias_curve.md#bisection.
    [[nodiscard]] scene::Image<float> find_critical_biases(const LookedUp& from,
                                                           const scene::Job& job,
                                                           const scene::View& view,
                                                           const Bisection& asked = {});

    /// What the view's biases beside constant and slope do to each lookup, as `render` has it. Top
    /// left first.
    [[nodiscard]] scene::LookupTerms read_terms(const LookedUp& from, const scene::Job& job,
                                                const scene::View& view);

private:
    /// What is computed of each pixel; without both the verdict.
    struct Computes {
        bool critical_bias = false;
        bool terms = false;
        renderers::ReceiverDepths depths;
        float lit_from = {}; ///< of a critical bias
    };
    /// What a program is compiled with for a job.
    struct Snippets {
        const methods::Passes& passes;
        std::span<const methods::ActiveBias> biases;
    };
    const Program& program(const LookedUp& from, const scene::Job& job, const scene::View& view,
                           const Snippets& snippets, const Computes& computes);
    /// @param scatters  the lookups' taps, whose kernels' axes are handed out.
    void allocate(const scene::View& view, bool scatters);
    /// Draws to the bound framebuffer.
    void draw(const LookedUp& from, const scene::Job& job, const scene::View& view,
              const Computes& computes);
    void bind_map(const LookedUp& from, const methods::Passes& passes,
                  scene::Outside outside) const;
    /// @param faces  of a cube, as a cube map: what GL filters.
    void bind_cube(const Texture& faces, const methods::Passes& passes) const;

    const Context& context_;
    std::map<std::string, Program> programs_;
    VertexArray no_attributes_;
    Sampler map_sampler_;
    Sampler compare_sampler_;
    Sampler filtered_sampler_;
    Framebuffer target_;
    Texture samples_;
    Texture texels_;
    Texture maps_;        ///< where the light has several
    Texture next_texels_; ///< where two are mixed
    Texture kernel_axes_; ///< where taps are scattered
    scene::ImageSize size_{0, 0};
    int equal_taps_ = 0; ///< of what was drawn last
};

} // namespace gnomon::raster_gl
