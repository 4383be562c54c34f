#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace gnomon::raster_gl {

/// Owns one OpenGL object name; move-only, 0 means empty. The context that created the object must
/// be current when the owner is destroyed.
template <void (*destroy)(GLuint)>
class GlObject {
public:
    GlObject() = default;
    explicit GlObject(GLuint name) noexcept : name_{name} {}
    GlObject(GlObject&& other) noexcept : name_{std::exchange(other.name_, 0)} {}
    GlObject& operator=(GlObject&& other) noexcept
    {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlObject()
    {
        if (name_ != 0) {
            destroy(name_);
        }
    }
    [[nodiscard]] GLuint name() const noexcept { return name_; }
    [[nodiscard]] bool empty() const noexcept { return name_ == 0; }

private:
    GLuint name_ = 0;
};

inline void destroy_texture(GLuint name)
{
    glDeleteTextures(1, &name);
}
inline void destroy_buffer(GLuint name)
{
    glDeleteBuffers(1, &name);
}
inline void destroy_framebuffer(GLuint name)
{
    glDeleteFramebuffers(1, &name);
}
inline void destroy_vertex_array(GLuint name)
{
    glDeleteVertexArrays(1, &name);
}
inline void destroy_sampler(GLuint name)
{
    glDeleteSamplers(1, &name);
}
inline void destroy_program(GLuint name)
{
    glDeleteProgram(name);
}
inline void destroy_shader(GLuint name)
{
    glDeleteShader(name);
}

using Texture = GlObject<destroy_texture>;
using Buffer = GlObject<destroy_buffer>;
using Framebuffer = GlObject<destroy_framebuffer>;
using VertexArray = GlObject<destroy_vertex_array>;
using Sampler = GlObject<destroy_sampler>;
using Program = GlObject<destroy_program>;
using Shader = GlObject<destroy_shader>;

[[nodiscard]] inline Buffer make_buffer()
{
    GLuint name = 0;
    glCreateBuffers(1, &name);
    return Buffer{name};
}
[[nodiscard]] inline Framebuffer make_framebuffer()
{
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return Framebuffer{name};
}
[[nodiscard]] inline VertexArray make_vertex_array()
{
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArray{name};
}
[[nodiscard]] inline Sampler make_sampler()
{
    GLuint name = 0;
    glCreateSamplers(1, &name);
    return Sampler{name};
}
/// An immutable 2D texture, sampled at the nearest texel of its first level: integer textures with
/// GL's default filters are incomplete, and then read as 0.
[[nodiscard]] inline Texture make_texture(GLenum internal_format, int width_texels,
                                          int height_texels, int levels = 1)
{
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, levels, internal_format, width_texels, height_texels);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return Texture{name};
}

} // namespace gnomon::raster_gl
