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

struct Layers {
    std::size_t first;
    std::size_t count;
};

/// The first level of layers, as a texture of another kind.
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
