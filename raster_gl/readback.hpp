#pragma once

#include "raster_gl/gl_object.hpp"
#include "scene/image.hpp"

#include <algorithm>

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
/// @tparam Pixel  laid out as `format` and `type` say.
template <typename Pixel>
[[nodiscard]] scene::Image<Pixel> read_texture(const Texture& texture, scene::ImageSize size,
                                               GLenum format, GLenum type)
{
    scene::Image<Pixel> image{size};
    // Above 2 GiB GL's byte count cannot name the size; it is only a guard, so it saturates.
    const std::size_t bytes =
        std::min<std::size_t>(image.pixel_count() * sizeof(Pixel), 0x7FFFFFFF);
    glGetTextureImage(texture.name(), 0, format, type, static_cast<GLsizei>(bytes), image.data());
    flip_rows(image);
    return image;
}

/// The image as a texture, bit for bit, its lowest row first.
[[nodiscard]] inline Texture upload(scene::Image<float> image)
{
    const scene::ImageSize size = image.size();
    flip_rows(image);
    Texture texture = make_texture(GL_R32F, size.width_px, size.height_px);
    glTextureSubImage2D(texture.name(), 0, 0, 0, size.width_px, size.height_px, GL_RED, GL_FLOAT,
                        image.data());
    return texture;
}

} // namespace gnomon::raster_gl
