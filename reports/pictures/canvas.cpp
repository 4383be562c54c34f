#include "reports/pictures/canvas.hpp"

#include <algorithm>

namespace gnomon::reports {

namespace {

/// The longest beginning of at most `bytes` that splits no code point.
std::string_view beginning(std::string_view text, std::size_t bytes)
{
    const auto is_continuation = [&](std::size_t i) {
        return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
    };
    while (bytes > 0 && is_continuation(bytes)) {
        --bytes;
    }
    return text.substr(0, bytes);
}

} // namespace

Canvas::Canvas(scene::ImageSize size, store::Rgb background,
               const std::filesystem::path& font_folder)
    : image_{size, background},
      font_{font_folder / "DejaVuSans.ttf"},
      bold_font_{font_folder / "DejaVuSans-Bold.ttf"}
{
}

void Canvas::paste(const store::RgbImage& image, int left, int top)
{
    const int height_px = std::min(image.size().height_px, image_.size().height_px - top);
    const int width_px = std::min(image.size().width_px, image_.size().width_px - left);
    for (int y = std::max(0, -top); y < height_px; ++y) {
        for (int x = std::max(0, -left); x < width_px; ++x) {
            image_(left + x, top + y) = image(x, y);
        }
    }
}

void Canvas::fill(int left, int top, scene::ImageSize size, store::Rgb colour)
{
    paste(store::RgbImage{size, colour}, left, top);
}

void Canvas::write(int left, int baseline, std::string_view text, const TextStyle& style)
{
    font(style).draw(text, style.size_px, left, baseline, style.colour, image_);
}

int Canvas::text_width_px(std::string_view text, const TextStyle& style) const
{
    return font(style).width_px(text, style.size_px);
}

std::string Canvas::fitted(std::string_view text, const TextStyle& style, int width_px) const
{
    if (text_width_px(text, style) <= width_px) {
        return std::string{text};
    }
    const auto shortened = [&](std::size_t bytes) {
        return std::string{beginning(text, bytes)} + "...";
    };
    // By halves: measuring a text costs as much as its length, and names come from files.
    std::size_t fits = 0;
    for (std::size_t too_long = text.size(); too_long - fits > 1;) {
        const std::size_t middle = fits + (too_long - fits) / 2;
        (text_width_px(shortened(middle), style) <= width_px ? fits : too_long) = middle;
    }
    return shortened(fits);
}

} // namespace gnomon::reports
