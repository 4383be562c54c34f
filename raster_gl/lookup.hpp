#pragma once

#include "methods/bias_term.hpp"
#include "methods/passes.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/map/shadow_map.hpp"
#include "raster_gl/program.hpp"
#include "raster_gl/receivers.hpp"
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

/// The receivers of a lookup, and the map that they read.
struct LookupSource {
    const GpuScene& scene;
    const ReceiverBuffer& receivers;
    const ShadowMap& map;
    const LayeredTexture* filtered = nullptr; ///< the prefiltered map, or null
};

/// The parameters of a bisection for critical biases.
struct Bisection {
    float lit_from = 0.5F; ///< the smallest verdict that counts as lit
    renderers::ReceiverDepths receiver_depths;
};

/// Looks up every receiver in the shadow map or its prefiltered form; with several maps, in the one
/// that `scene::MapChoice` selects.
///
/// The view's biases are uniforms. The result holds r, d and tan θ, with r before constant and
/// slope bias, so those two can be changed later without GL.
class LookupPass {
public:
    explicit LookupPass(const Context& context);

    /// Draws the lookup; `read` returns the result.
    /// @throws std::invalid_argument  if the receivers' size or the number of maps differs from the
    ///                                view's, or several maps are looked up from vertices.
    void render(const LookupSource& from, const scene::Job& job, const scene::View& view,
                const renderers::ReceiverDepths& receiver_depths = {});

    /// The result of the last `render`, in images of the view's size, top left first. Shares of
    /// equal taps are rounded to the nearest float32, as the shader's division may miss it (GLSL
    /// 4.5, 4.7.1: 2.5 ulp).
    [[nodiscard]] scene::LookupLayers read() const;

    /// The smallest constant bias per pixel for which `render`'s verdict reaches `asked.lit_from`,
    /// with the view's other biases. The shader bisects in one draw, so the result holds for the
    /// driver's arithmetic as long as the verdict rises with the bias.
    /// @return  0 or a normal float32; −∞ if lit for every bias, +∞ if shadowed for every bias; 0
    ///          without a receiver. Top left first.
    /// @throws std::invalid_argument  as `render`.
    /// Source: docs/bias_curve.md#bisection.
    [[nodiscard]] scene::Image<float> find_critical_biases(const LookupSource& from,
                                                           const scene::Job& job,
                                                           const scene::View& view,
                                                           const Bisection& asked = {});

    /// The effect of the view's biases other than constant and slope on each lookup of `render`.
    /// Top left first.
    [[nodiscard]] scene::LookupTerms read_terms(const LookupSource& from, const scene::Job& job,
                                                const scene::View& view);

private:
    /// What the shader computes per pixel; neither flag means the verdict.
    struct Outputs {
        bool critical_bias = false;
        bool terms = false;
        renderers::ReceiverDepths depths;
        float lit_from = {}; ///< for the critical bias
    };
    /// The snippets that a job's program is compiled from.
    struct Snippets {
        const methods::Passes& passes;
        std::span<const methods::ActiveBias> biases;
    };
    [[nodiscard]] static Definitions definitions(const LookupSource& from, const scene::Job& job,
                                                 const scene::View& view, const Snippets& snippets,
                                                 const Outputs& outputs);
    const Program& program(const LookupSource& from, const scene::Job& job, const scene::View& view,
                           const Snippets& snippets, const Outputs& outputs);
    /// @param scatters  whether taps are scattered, so that kernel axes are written.
    void allocate(const scene::View& view, bool scatters);
    /// Draws into the bound framebuffer.
    void draw(const LookupSource& from, const scene::Job& job, const scene::View& view,
              const Outputs& outputs);
    void bind_map(const LookupSource& from, const methods::Passes& passes,
                  scene::Outside outside) const;
    /// @param faces  a cube-map view, which GL filters.
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
    Texture maps_;        ///< if the light has several maps
    Texture next_texels_; ///< if two maps are blended
    Texture kernel_axes_; ///< if taps are scattered
    scene::ImageSize size_{0, 0};
    int equal_taps_ = 0; ///< of the last `render`
};

} // namespace gnomon::raster_gl
