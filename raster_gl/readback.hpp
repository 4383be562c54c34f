#pragma once

#include "raster_gl/gl_object.hpp"
#include "scene/image.hpp"

#include <algorithm>
#include <span>

namespace gnomon::raster_gl {

/// Turns GL's lower-left origin into the top-left origin of images, in place.
template <typename Pixel>
void flip_rows(scene::Image<Pixel>& image)
{
    const auto width = static_cast<std::ptrdiff_t>(image.size().width_px);
    const int height = image.size().height_px;
    for (int y = 0; y < height / 2; ++y) {
        Pixel* const upper = image.data() + y * width;
        Pixel* const lower = image.data() + (height - 1 - y) * width;
        std::swap_ranges(upper, upper + width, lower);
    }
}

/// Level 0 of a texture, bit for bit, flipped once to the top-left origin.
/// @tparam Pixel laid out as `format` and `type` describe.
template <typename Pixel>
[[nodiscard]] scene::Image<Pixel> read_texture(const Texture& texture, scene::ImageSize size,
                                               GLenum format, GLenum type)
{
    scene::Image<Pixel> image{size};
    // GL's byte count is only a bounds check, so it may saturate at 2 GiB.
    const std::size_t bytes =
        std::min<std::size_t>(image.pixel_count() * sizeof(Pixel), 0x7FFFFFFF);
    glGetTextureImage(texture.name(), 0, format, type, static_cast<GLsizei>(bytes), image.data());
    flip_rows(image);
    return image;
}

/// Uploads the image bit for bit, lowest row first.
[[nodiscard]] inline Texture upload(scene::Image<float> image)
{
    const scene::ImageSize size = image.size();
    flip_rows(image);
    Texture texture = make_texture(GL_R32F, size.width_px, size.height_px);
    glTextureSubImage2D(texture.name(), 0, 0, 0, size.width_px, size.height_px, GL_RED, GL_FLOAT,
                        image.data());
    return texture;
}

/// Uploads images of one size as the layers of an array texture, bit for bit, lowest row first.
[[nodiscard]] inline Texture upload_layers(std::span<scene::Image<float>> images)
{
    const scene::ImageSize size = images.front().size();
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    glTextureStorage3D(name, 1, GL_R32F, size.width_px, size.height_px,
                       static_cast<GLsizei>(images.size()));
    GLint layer = 0;
    for (scene::Image<float>& image : images) {
        flip_rows(image);
        glTextureSubImage3D(name, 0, 0, 0, layer++, size.width_px, size.height_px, 1, GL_RED,
                            GL_FLOAT, image.data());
    }
    return Texture{name};
}

} // namespace gnomon::raster_gl
