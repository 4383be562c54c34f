#pragma once

#include "reports/pictures/font.hpp"
#include "store/images/png.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// Where Debian's fonts-dejavu-core puts its fonts.
inline constexpr std::string_view default_font_folder = "/usr/share/fonts/truetype/dejavu";

/// How a text looks.
struct TextStyle {
    int size_px = 16;
    bool bold = false;
    store::Rgb colour{34, 34, 34};
};

/// An image to paste pictures, rectangles and text on.
class Canvas {
public:
    /// @throws scene::EnvironmentError  naming the package, if the fonts are not in the folder.
    Canvas(scene::ImageSize size, store::Rgb background, const std::filesystem::path& font_folder);

    void paste(const store::RgbImage& image, int left, int top);
    /// Fills the part of the rectangle that lies on the canvas.
    void fill(int left, int top, scene::ImageSize size, store::Rgb colour);
    /// Writes one line whose baseline starts at (left, baseline); bytes that are no UTF-8 become
    /// "?".
    void write(int left, int baseline, std::string_view text, const TextStyle& style);
    /// Advance of a line [px].
    [[nodiscard]] int text_width_px(std::string_view text, const TextStyle& style) const;
    /// The text if it fits into the width, else its beginning and three dots.
    [[nodiscard]] std::string fitted(std::string_view text, const TextStyle& style,
                                     int width_px) const;

    [[nodiscard]] const store::RgbImage& image() const { return image_; }

private:
    [[nodiscard]] const Font& font(const TextStyle& style) const
    {
        return style.bold ? bold_font_ : font_;
    }

    store::RgbImage image_;
    Font font_;
    Font bold_font_;
};

} // namespace gnomon::reports
