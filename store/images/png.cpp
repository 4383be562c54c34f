#include "store/images/png.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <png.h>

namespace gnomon::store {

namespace {

static_assert(sizeof(Rgb) == 3, "pixels are packed as the encoder expects them");

/// Owns libpng's control structure.
struct PngImage : png_image {
    PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
    ~PngImage() { png_image_free(this); }
};

std::vector<std::byte> encode(scene::ImageSize size, png_uint_32 format, const void* samples)
{
    PngImage image;
    image.width = static_cast<png_uint_32>(size.width_px);
    image.height = static_cast<png_uint_32>(size.height_px);
    image.format = format;
    png_alloc_size_t length = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> bytes(length);
    if (png_image_write_to_memory(&image, bytes.data(), &length, 0, samples, 0, nullptr) == 0) {
        throw scene::EnvironmentError(
            fmt::format("libpng failed to encode a picture of {} × {} pixels: {}; make it smaller",
                        size.width_px, size.height_px, image.message));
    }
    bytes.resize(length);
    return bytes;
}

} // namespace

std::vector<std::byte> encode_png(const RgbImage& image)
{
    return encode(image.size(), PNG_FORMAT_RGB, image.data());
}

std::vector<std::byte> encode_png(const scene::Image<std::uint8_t>& grey)
{
    return encode(grey.size(), PNG_FORMAT_GRAY, grey.data());
}

scene::Image<std::uint8_t> decode_grey_png(std::string_view bytes, scene::ImageSize size)
{
    PngImage image;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
        throw scene::InputError("not a PNG image, or damaged");
    }
    if (image.width != static_cast<png_uint_32>(size.width_px) ||
        image.height != static_cast<png_uint_32>(size.height_px) ||
        image.format != PNG_FORMAT_GRAY) {
        throw scene::InputError("not an image with one grey channel of 8 bits");
    }
    scene::Image<std::uint8_t> grey{size};
    if (png_image_finish_read(&image, nullptr, grey.data(), 0, nullptr) == 0) {
        throw scene::InputError("damaged or truncated");
    }
    return grey;
}

} // namespace gnomon::store
