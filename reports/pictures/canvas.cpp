#include "reports/pictures/canvas.hpp"

#include "scene/error.hpp"
#include "scene/import/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include <ft2build.h>
#include FT_FREETYPE_H

namespace gnomon::reports {

struct Font::Face {
    FT_Library library = nullptr;
    FT_Face face = nullptr;
};

void Font::CloseFace::operator()(Face* face) const
{
    FT_Done_Face(face->face);
    FT_Done_FreeType(face->library);
    delete face;
}

namespace {

/// @param text  valid UTF-8.
std::u32string code_points(std::string_view text)
{
    std::u32string points;
    for (const char c : text) {
        const auto byte = static_cast<std::uint8_t>(c);
        const int ones = std::countl_one(byte);
        const auto bits = static_cast<char32_t>(byte & (0xFFU >> (ones + 1)));
        if (ones == 1) {
            points.back() = points.back() << 6U | bits;
        } else {
            points += bits;
        }
    }
    return points;
}

std::uint8_t blended(std::uint8_t paper, std::uint8_t ink, std::uint8_t coverage)
{
    const double share = coverage / 255.0;
    return static_cast<std::uint8_t>(std::lround(paper * (1 - share) + ink * share));
}

/// @param left, top  Position of the glyph's bitmap in the image.
void draw_glyph(const FT_Bitmap& glyph, int left, int top, store::Rgb colour,
                store::RgbImage& image)
{
    for (int row = 0; row < static_cast<int>(glyph.rows); ++row) {
        for (int column = 0; column < static_cast<int>(glyph.width); ++column) {
            const int x = left + column;
            const int y = top + row;
            if (x < 0 || y < 0 || x >= image.size().width_px || y >= image.size().height_px) {
                continue;
            }
            const std::uint8_t coverage =
                glyph.buffer[static_cast<std::ptrdiff_t>(row) * glyph.pitch + column];
            store::Rgb& pixel = image(x, y);
            pixel = {blended(pixel.r, colour.r, coverage), blended(pixel.g, colour.g, coverage),
                     blended(pixel.b, colour.b, coverage)};
        }
    }
}

/// Calls `draw` with each rendered glyph and its position [px]; skips glyphs that fail to load.
/// Returns the advance [px].
template <typename Draw>
int for_each_glyph(FT_Face face, std::string_view text, int size_px, const Draw& draw)
{
    FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size_px));
    FT_Pos at = 0; // in 1/64 px
    FT_UInt last = 0;
    for (const char32_t point : code_points(scene::printable(text))) {
        const FT_UInt glyph = FT_Get_Char_Index(face, point);
        FT_Vector kerning{};
        if (FT_Get_Kerning(face, last, glyph, FT_KERNING_DEFAULT, &kerning) == 0) {
            at += kerning.x;
        }
        last = glyph;
        if (FT_Load_Glyph(face, glyph, FT_LOAD_RENDER) == 0) {
            draw(*face->glyph, static_cast<int>(at / 64));
            at += face->glyph->advance.x;
        }
    }
    return static_cast<int>(at / 64);
}

} // namespace

Font::Font(const std::filesystem::path& file) : face_{new Face}
{
    if (FT_Init_FreeType(&face_->library) != 0 ||
        FT_New_Face(face_->library, file.c_str(), 0, &face_->face) != 0) {
        throw scene::EnvironmentError(
            fmt::format("cannot write text: the font {} is missing or damaged; install "
                        "fonts-dejavu-core",
                        file.string()));
    }
}

void Font::draw(std::string_view text, int size_px, int left, int baseline, store::Rgb colour,
                store::RgbImage& image) const
{
    for_each_glyph(face_->face, text, size_px, [&](const FT_GlyphSlotRec& glyph, int at) {
        draw_glyph(glyph.bitmap, left + at + glyph.bitmap_left, baseline - glyph.bitmap_top, colour,
                   image);
    });
}

int Font::width_px(std::string_view text, int size_px) const
{
    return for_each_glyph(face_->face, text, size_px, [](const FT_GlyphSlotRec&, int) {});
}

namespace {

/// The longest prefix of at most `bytes` that splits no code point.
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
    // Bisect, as names from files may be long and measuring takes linear time.
    std::size_t fits = 0;
    for (std::size_t too_long = text.size(); too_long - fits > 1;) {
        const std::size_t middle = fits + (too_long - fits) / 2;
        (text_width_px(shortened(middle), style) <= width_px ? fits : too_long) = middle;
    }
    return shortened(fits);
}

std::vector<std::string> Canvas::wrapped(std::string_view text, const TextStyle& style,
                                         int width_px, std::size_t most_lines) const
{
    std::vector<std::string> lines;
    while (lines.size() + 1 < most_lines && text_width_px(text, style) > width_px) {
        std::size_t end = text.find(' ');
        while (end != std::string_view::npos) {
            const std::size_t next = text.find(' ', end + 1);
            if (text_width_px(text.substr(0, next), style) > width_px) {
                break;
            }
            end = next;
        }
        if (end == std::string_view::npos) {
            break; // one word
        }
        lines.push_back(fitted(text.substr(0, end), style, width_px));
        text.remove_prefix(end + 1);
    }
    lines.push_back(fitted(text, style, width_px));
    return lines;
}

} // namespace gnomon::reports
