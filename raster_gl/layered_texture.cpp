#include "raster_gl/layered_texture.hpp"

namespace gnomon::raster_gl {
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

/// The first level of a layer.
Texture view_of_layer(const Texture& all, GLenum internal_format, std::size_t layer)
{
    GLuint name = 0;
    glGenTextures(1, &name);
    glTextureView(name, GL_TEXTURE_2D, all.name(), internal_format, 0, 1,
                  static_cast<GLuint>(layer), 1);
    sample_nearest(name);
    return Texture{name};
}

} // namespace

LayeredTexture::LayeredTexture(GLenum internal_format, int side_texels, std::size_t layers,
                               int levels)
{
    if (layers == 1) {
        all_ = make_texture(internal_format, side_texels, side_texels, levels);
        return;
    }
    all_ = make_array(internal_format, side_texels, layers, levels);
    for (std::size_t i = 0; i < layers; ++i) {
        layers_.push_back(view_of_layer(all_, internal_format, i));
    }
}

} // namespace gnomon::raster_gl
