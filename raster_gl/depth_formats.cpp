#include "raster_gl/depth_formats.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <array>

namespace gnomon::raster_gl {
namespace {

using Kind = scene::DepthFormat::Kind;

/// What GL gave for a texture.
struct Given {
    GLint bits = 0;
    bool is_float = false;
};

Given query(const Texture& texture, bool is_colour)
{
    Given given;
    GLint type = 0;
    const GLenum size_name = is_colour ? GL_TEXTURE_RED_SIZE : GL_TEXTURE_DEPTH_SIZE;
    const GLenum type_name = is_colour ? GL_TEXTURE_RED_TYPE : GL_TEXTURE_DEPTH_TYPE;
    glGetTextureLevelParameteriv(texture.name(), 0, size_name, &given.bits);
    glGetTextureLevelParameteriv(texture.name(), 0, type_name, &type);
    given.is_float = type == GL_FLOAT;
    return given;
}

Given query(const Texture& texture, scene::DepthFormat format)
{
    return query(texture, traits_of(format).is_colour);
}

bool matches(const Given& given, scene::DepthFormat format)
{
    const bool wants_float =
        format.is_float() || traits_of(format).conversion == scene::Conversion::shader;
    return given.is_float == wants_float && given.bits == (wants_float ? 32 : format.bits);
}

std::string words(const Given& given)
{
    return fmt::format("{} bits {}", given.bits, given.is_float ? "float" : "unorm");
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
    const Given given = query(texture, format);
    if (!matches(given, format)) {
        throw scene::InputError(
            fmt::format("shadow_map.depth_format = \"{}\": this driver stores {} instead; choose a "
                        "format that `gnomon doctor` lists",
                        scene::depth_format_name(format), words(given)));
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
        const Given given = query(texture, format);
        const bool supported = matches(given, format);
        result.push_back(
            {scene::depth_format_name(format), supported, supported ? "" : words(given)});
    }
    context.check("querying depth formats");
    return result;
}

} // namespace gnomon::raster_gl
