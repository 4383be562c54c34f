#pragma once

#include "methods/passes.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/layered_texture.hpp"
#include "raster_gl/program.hpp"
#include "raster_gl/shadow_map.hpp"
#include "renderers/rasterizer.hpp"

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::raster_gl {

/// Several depths of each texel: at samples, or of surfaces one behind the other.
struct SampledDepths {
    /// Of each map: a multisampled texture, or a layer for each depth. Empty: texel centres alone.
    std::span<const Texture> of_maps = {};
    bool are_layers = false;
};

/// What a pass made of each map.
struct FilteredTexture {
    LayeredTexture texture;
    GLenum format = 0;
    int resolution_texels = 0;
    int levels = 0;
};

/// Runs the passes that a method makes of a map before it is looked up.
class PrefilterPass {
public:
    explicit PrefilterPass(const Context& context);

    /// @param samples  what the first pass reads where the passes ask for samples or layers.
    /// @return  What the last pass made of each map, the object's own; empty without passes. The
    ///          next call overwrites it.
    /// @throws scene::InputError        if the driver lacks a format.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    const LayeredTexture&
    render(const ShadowMap& map, const methods::Passes& passes,
           renderers::FilteredContent content = renderers::FilteredContent::of_method,
           const SampledDepths& samples = {});
    /// What `render` made last, which is the pass's own no longer; empty without passes.
    [[nodiscard]] FilteredTexture take();
    /// Takes a texture that nobody needs: it is used again where the next one is like it.
    void give_back(FilteredTexture texture) { spare_ = std::move(texture); }
    /// Gives the memory back.
    void forget();

private:
    /// What a pass reads of each map.
    struct Source {
        std::vector<const Texture*> of_maps;
        int samples = 1;
        bool are_layers = false;
    };
    [[nodiscard]] static Source layers_of(const LayeredTexture& texture);
    [[nodiscard]] static Source first_source(const ShadowMap& map, const methods::Passes& passes,
                                             const SampledDepths& samples);
    /// @param stores_half_floats  Whether what it draws into holds 16-bit floats.
    const Program& program(const methods::GlslSnippet& snippet, const Source& source,
                           bool stores_half_floats);
    /// Draws the pass's texture, which is made first where it is not such a one.
    void draw(const methods::PrefilterPass& pass, const Source& source, int resolution_texels,
              int levels, renderers::FilteredContent content, FilteredTexture& made);

    const Context& context_;
    std::map<std::string, Program> programs_;
    VertexArray no_attributes_;
    Framebuffer target_;
    std::vector<FilteredTexture> made_; ///< by pass
    FilteredTexture spare_;             ///< for the last
    LayeredTexture nothing_;
};

} // namespace gnomon::raster_gl
