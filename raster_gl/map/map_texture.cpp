#include "raster_gl/map/map_texture.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <array>

namespace gnomon::raster_gl {

namespace {

using Kind = scene::DepthFormat::Kind;

/// The format that GL chose for a texture.
struct StoredFormat {
    GLint bits = 0;
    bool is_float = false;
};

StoredFormat query(const Texture& texture, bool is_colour)
{
    StoredFormat stored;
    GLint type = 0;
    const GLenum size_name = is_colour ? GL_TEXTURE_RED_SIZE : GL_TEXTURE_DEPTH_SIZE;
    const GLenum type_name = is_colour ? GL_TEXTURE_RED_TYPE : GL_TEXTURE_DEPTH_TYPE;
    glGetTextureLevelParameteriv(texture.name(), 0, size_name, &stored.bits);
    glGetTextureLevelParameteriv(texture.name(), 0, type_name, &type);
    stored.is_float = type == GL_FLOAT;
    return stored;
}

StoredFormat query(const Texture& texture, scene::DepthFormat format)
{
    return query(texture, traits_of(format).is_colour);
}

bool matches(const StoredFormat& stored, scene::DepthFormat format)
{
    const bool wants_float =
        format.is_float() || traits_of(format).conversion == scene::Conversion::shader;
    return stored.is_float == wants_float && stored.bits == (wants_float ? 32 : format.bits);
}

std::string format_text(const StoredFormat& stored)
{
    return fmt::format("{} bits {}", stored.bits, stored.is_float ? "float" : "unorm");
}

} // namespace

GLenum internal_format(scene::DepthFormat format)
{
    switch (format.kind) {
    case Kind::d16:
        return GL_DEPTH_COMPONENT16;
    case Kind::d24:
        return GL_DEPTH_COMPONENT24;
    case Kind::d32:
        return GL_DEPTH_COMPONENT32;
    case Kind::r32f:
    case Kind::r16f:
    case Kind::rgba8:
        return GL_R32F;
    case Kind::d32f:
    case Kind::unorm:
        break;
    }
    return GL_DEPTH_COMPONENT32F;
}

void require_format(const Texture& texture, scene::DepthFormat format)
{
    const StoredFormat stored = query(texture, format);
    if (!matches(stored, format)) {
        throw scene::InputError(
            fmt::format("shadow_map.depth_format = \"{}\": this driver stores {} instead; choose a "
                        "format that `gnomon doctor` lists",
                        scene::depth_format_name(format), format_text(stored)));
    }
}

std::vector<FormatSupport> query_depth_formats(const Context& context)
{
    std::vector<FormatSupport> result;
    for (const scene::DepthFormat format : scene::depth_formats()) {
        if (traits_of(format).conversion != scene::Conversion::gl) {
            continue;
        }
        const Texture texture = make_texture(internal_format(format), 4, 4);
        const StoredFormat stored = query(texture, format);
        const bool supported = matches(stored, format);
        result.push_back(
            {scene::depth_format_name(format), supported, supported ? "" : format_text(stored)});
    }
    context.check("querying depth formats");
    return result;
}

namespace {

void sample_nearest(GLuint texture)
{
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Texture make_array(GLenum internal_format, int side_texels, std::size_t layers, int levels)
{
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    glTextureStorage3D(name, levels, internal_format, side_texels, side_texels,
                       static_cast<GLsizei>(layers));
    sample_nearest(name);
    return Texture{name};
}

struct Layers {
    std::size_t first;
    std::size_t count;
};

/// A view of the first level of some layers, as another texture target.
Texture view_of(const Texture& all, GLenum kind, GLenum internal_format, const Layers& layers)
{
    GLuint name = 0;
    glGenTextures(1, &name);
    glTextureView(name, kind, all.name(), internal_format, 0, 1, static_cast<GLuint>(layers.first),
                  static_cast<GLuint>(layers.count));
    sample_nearest(name);
    return Texture{name};
}

} // namespace

LayeredTexture::LayeredTexture(GLenum internal_format, int side_texels, std::size_t layers,
                               int levels)
    : internal_format_{internal_format}
{
    if (layers == 1) {
        all_ = make_texture(internal_format, side_texels, side_texels, levels);
        return;
    }
    all_ = make_array(internal_format, side_texels, layers, levels);
    for (std::size_t i = 0; i < layers; ++i) {
        layers_.push_back(view_of(all_, GL_TEXTURE_2D, internal_format, {i, 1}));
    }
}

Texture LayeredTexture::cube_view() const
{
    return view_of(all_, GL_TEXTURE_CUBE_MAP, internal_format_, {0, layers_.size()});
}

} // namespace gnomon::raster_gl
