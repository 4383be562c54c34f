#include "raster_gl/map/prefilter.hpp"

#include "raster_gl/glsl_snippets.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <bit>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::raster_gl {
namespace {

using methods::TexelFormat;
using renderers::FilteredContent;

/// GL's name for a format, and what its texels hold.
struct GlTexelFormat {
    GLenum internal = 0;
    std::string_view name;
    GLenum type = 0; ///< of the red component
    GLint red_bits = 0;
};

/// The format with the same components as 32-bit floats.
TexelFormat float32_of(TexelFormat format)
{
    switch (format) {
    case TexelFormat::r16f:
    case TexelFormat::r32f:
        return TexelFormat::r32f;
    case TexelFormat::rg16:
    case TexelFormat::rg16f:
    case TexelFormat::rg32f:
        return TexelFormat::rg32f;
    case TexelFormat::rgba16:
    case TexelFormat::rgba16f:
    case TexelFormat::rgba32f:
        return TexelFormat::rgba32f;
    }
    return format;
}

GlTexelFormat gl_format(TexelFormat format)
{
    switch (format) {
    case TexelFormat::r16f:
        return {GL_R16F, "r16f", GL_FLOAT, 16};
    case TexelFormat::r32f:
        return {GL_R32F, "r32f", GL_FLOAT, 32};
    case TexelFormat::rg16:
        return {GL_RG16, "rg16", GL_UNSIGNED_NORMALIZED, 16};
    case TexelFormat::rg16f:
        return {GL_RG16F, "rg16f", GL_FLOAT, 16};
    case TexelFormat::rg32f:
        return {GL_RG32F, "rg32f", GL_FLOAT, 32};
    case TexelFormat::rgba16:
        return {GL_RGBA16, "rgba16", GL_UNSIGNED_NORMALIZED, 16};
    case TexelFormat::rgba16f:
        return {GL_RGBA16F, "rgba16f", GL_FLOAT, 16};
    case TexelFormat::rgba32f:
        return {GL_RGBA32F, "rgba32f", GL_FLOAT, 32};
    }
    return {};
}

bool is_half_float(const GlTexelFormat& format)
{
    return format.type == GL_FLOAT && format.red_bits == 16;
}

/// Drivers need not support rendering to a format or filtering it, and may store more or fewer bits
/// than requested.
void require_format(const Texture& texture, const GlTexelFormat& asked)
{
    for (const auto& [ability, verb] :
         {std::pair{GLenum{GL_FRAMEBUFFER_RENDERABLE}, "draw into"}, {GL_FILTER, "filter"}}) {
        GLint support = GL_NONE;
        glGetInternalformativ(GL_TEXTURE_2D, asked.internal, ability, 1, &support);
        if (support == GL_NONE) {
            throw scene::InputError(fmt::format(
                "the map's content {}: this driver does not {} it; choose another content",
                asked.name, verb));
        }
    }
    GLint bits = 0;
    GLint type = 0;
    glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_RED_SIZE, &bits);
    glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_RED_TYPE, &type);
    if (bits != asked.red_bits || static_cast<GLenum>(type) != asked.type) {
        throw scene::InputError(
            fmt::format("the map's content {}: this driver stores {} bits instead; choose another "
                        "content",
                        asked.name, bits));
    }
}

} // namespace

PrefilterPass::PrefilterPass(const Context& context)
    : context_{context},
      no_attributes_{make_vertex_array()},
      target_{make_framebuffer()}
{
    context.check("preparing the prefilter");
}

PrefilterPass::Source PrefilterPass::layers_of(const LayeredTexture& texture)
{
    Source source;
    for (std::size_t i = 0; i < texture.layer_count(); ++i) {
        source.of_maps.push_back(&texture.layer(i));
    }
    return source;
}

PrefilterPass::Source PrefilterPass::first_source(const ShadowMap& map,
                                                  const methods::Passes& passes,
                                                  const SampledDepths& samples)
{
    if (passes.depths_of_texel() == 1) {
        return layers_of(map.depth);
    }
    if (samples.of_maps.size() != map.depth.layer_count()) {
        throw std::invalid_argument("PrefilterPass: the passes need several depths per texel");
    }
    Source source{{}, passes.depths_of_texel(), samples.are_layers};
    for (const Texture& texture : samples.of_maps) {
        source.of_maps.push_back(&texture);
    }
    return source;
}

const Program& PrefilterPass::program(const methods::GlslSnippet& snippet, const Source& source,
                                      bool stores_half_floats)
{
    Definitions definitions{{"HALF_FLOATS", stores_half_floats ? "1" : "0"},
                            {"SAMPLES", std::to_string(source.samples)},
                            {"SAMPLES_ARE_LAYERS", source.are_layers ? "1" : "0"}};
    add_definitions(snippet, definitions);
    const std::string key = program_key(snippet.glsl, definitions);
    const auto found = programs_.find(key);
    if (found != programs_.end()) {
        return found->second;
    }
    Program made = make_program({"fullscreen.vert", "prefilter.frag", definitions, nullptr,
                                 snippets_before_shader("prefilter_source.glsl", snippet)});
    return programs_.emplace(key, std::move(made)).first->second;
}

void PrefilterPass::draw(const methods::PrefilterPass& pass, const Source& source,
                         int resolution_texels, int levels, FilteredContent content,
                         FilteredTexture& made)
{
    const GlTexelFormat format =
        gl_format(content == FilteredContent::float32 ? float32_of(pass.format) : pass.format);
    const std::size_t maps = source.of_maps.size();
    if (made.format != format.internal || made.resolution_texels != resolution_texels ||
        made.levels != levels || made.texture.layer_count() != maps) {
        made = {}; // free the old texture before allocating the new one
        LayeredTexture texture{format.internal, resolution_texels, maps, levels};
        require_format(texture.layer(0), format);
        made = {std::move(texture), format.internal, resolution_texels, levels};
    }
    const Program& texel = program(pass.snippet, source, is_half_float(format));
    set_uniforms(texel, pass.snippet);
    glUseProgram(texel.name());
    for (std::size_t i = 0; i < maps; ++i) {
        glNamedFramebufferTexture(target_.name(), GL_COLOR_ATTACHMENT0,
                                  made.texture.layer(i).name(), 0);
        glBindTextureUnit(0, source.of_maps[i]->name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
}

const LayeredTexture& PrefilterPass::render(const ShadowMap& map, const methods::Passes& passes,
                                            FilteredContent content, const SampledDepths& samples)
{
    if (passes.prefilter.empty()) {
        forget();
        return nothing_;
    }
    made_.resize(passes.prefilter.size());
    if (made_.back().texture.empty()) {
        made_.back() = std::exchange(spare_, {});
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    glViewport(0, 0, map.resolution_texels, map.resolution_texels);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindSampler(0, 0);
    glBindVertexArray(no_attributes_.name());
    const auto all_levels = std::bit_width(static_cast<unsigned>(map.resolution_texels));
    Source source = first_source(map, passes, samples);
    for (std::size_t i = 0; i < made_.size(); ++i) {
        const bool has_levels = passes.makes_mipmaps && i + 1 == made_.size();
        draw(passes.prefilter[i], source, map.resolution_texels,
             has_levels ? static_cast<int>(all_levels) : 1, content, made_[i]);
        source = layers_of(made_[i].texture);
    }
    const LayeredTexture& last = made_.back().texture;
    if (passes.makes_mipmaps) {
        glGenerateTextureMipmap(last.name());
    }
    glFinish();
    context_.check(fmt::format("prefiltering a map of {0}×{0} texels", map.resolution_texels));
    return last;
}

FilteredTexture PrefilterPass::take()
{
    target_ = make_framebuffer(); // a framebuffer keeps its attachments alive
    return made_.empty() ? FilteredTexture{} : std::exchange(made_.back(), {});
}

void PrefilterPass::forget()
{
    target_ = make_framebuffer();
    made_.clear();
    spare_ = {};
}

} // namespace gnomon::raster_gl
