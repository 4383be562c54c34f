#pragma once

#include "methods/passes.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/map/shadow_map.hpp"
#include "raster_gl/program.hpp"
#include "renderers/rasterizer.hpp"

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::raster_gl {

/// Several depths per texel: multisampled, or peeled layers.
struct SampledDepths {
    /// For each map a multisampled texture, or an array with a layer for each depth; empty if only
    /// texel centres are drawn.
    std::span<const Texture> of_maps = {};
    bool are_layers = false;
};

/// The output of a prefilter pass, a layer for each map.
struct FilteredTexture {
    LayeredTexture texture;
    GLenum format = 0;
    int resolution_texels = 0;
    int levels = 0;
};

/// Runs a method's prefilter passes over a map before lookups.
class PrefilterPass {
public:
    explicit PrefilterPass(const Context& context);

    /// @param samples  input of the first pass if the passes ask for samples or layers.
    /// @return  The output of the last pass, owned by this object until the next call; empty
    ///          without passes.
    /// @throws scene::InputError        if the driver lacks a format.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    const LayeredTexture&
    render(const ShadowMap& map, const methods::Passes& passes,
           renderers::FilteredContent content = renderers::FilteredContent::of_method,
           const SampledDepths& samples = {});
    /// Moves out the last output of `render`; empty without passes.
    [[nodiscard]] FilteredTexture take();
    /// Takes back an unused texture to recycle it if the next one has the same format and size.
    void give_back(FilteredTexture texture) { spare_ = std::move(texture); }
    /// Frees all textures.
    void forget();

private:
    /// The input of a pass, a texture for each map.
    struct Source {
        std::vector<const Texture*> of_maps;
        int samples = 1;
        bool are_layers = false;
    };
    [[nodiscard]] static Source layers_of(const LayeredTexture& texture);
    [[nodiscard]] static Source first_source(const ShadowMap& map, const methods::Passes& passes,
                                             const SampledDepths& samples);
    /// @param stores_half_floats  whether the target holds 16-bit floats.
    const Program& program(const methods::GlslSnippet& snippet, const Source& source,
                           bool stores_half_floats);
    /// Draws the pass into `made`, reallocating it if its format or size differs.
    void draw(const methods::PrefilterPass& pass, const Source& source, int resolution_texels,
              int levels, renderers::FilteredContent content, FilteredTexture& made);

    const Context& context_;
    std::map<std::string, Program> programs_;
    VertexArray no_attributes_;
    Framebuffer target_;
    std::vector<FilteredTexture> made_; ///< output of each pass
    FilteredTexture spare_;             ///< recycled for the last pass
    LayeredTexture nothing_;
};

} // namespace gnomon::raster_gl
