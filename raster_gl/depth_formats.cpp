#include "raster_gl/depth_formats.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <array>

namespace gnomon::raster_gl {
namespace {

using Kind = scene::DepthFormat::Kind;

/// What GL gave for a depth texture.
struct Given {
    GLint bits = 0;
    bool is_float = false;
};

Given query(const Texture& texture)
{
    Given given;
    GLint type = 0;
    glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_DEPTH_SIZE, &given.bits);
    glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_DEPTH_TYPE, &type);
    given.is_float = type == GL_FLOAT;
    return given;
}

bool matches(const Given& given, scene::DepthFormat format)
{
    const bool wants_float = format.kind == Kind::d32f || format.kind == Kind::unorm;
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
    case Kind::d32f:
    case Kind::unorm:
        break;
    }
    return GL_DEPTH_COMPONENT32F;
}

void require_format(const Texture& texture, scene::DepthFormat format)
{
    const Given given = query(texture);
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
    for (const char* name : {"d16", "d24", "d32", "d32f"}) {
        const scene::DepthFormat format = scene::depth_format_from_name(name).value();
        const Texture texture = make_texture(internal_format(format), 4, 4);
        const Given given = query(texture);
        const bool supported = matches(given, format);
        result.push_back({name, supported, supported ? "" : words(given)});
    }
    context.check("querying depth formats");
    return result;
}

} // namespace gnomon::raster_gl
