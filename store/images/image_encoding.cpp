#include "store/images/image_encoding.hpp"

namespace gnomon::store {

namespace {

static_assert(sizeof(Rgb) == 3, "pixels are packed as the codec expects them");

} // namespace

std::uint8_t* samples_of(RgbImage& image)
{
    return &image.data()->r;
}

std::vector<std::byte> encode_png(const RgbImage& image)
{
    return image_codec().encode_png(image.size(), 3, &image.data()->r);
}

std::vector<std::byte> encode_png(const scene::Image<std::uint8_t>& grey)
{
    return image_codec().encode_png(grey.size(), 1, grey.data());
}

std::vector<std::byte> encode_exr(scene::ImageSize size, std::span<const ExrChannel> channels,
                                  std::span<const ExrAttribute> attributes)
{
    const ExrPart part{size, channels, attributes};
    return encode_exr({&part, 1});
}

std::vector<std::byte> encode_exr(std::span<const ExrPart> parts)
{
    return image_codec().encode_exr(parts);
}

} // namespace gnomon::store
