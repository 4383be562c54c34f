#pragma once

#include "store/images/png.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// The font folder of Debian's package fonts-dejavu-core.
inline constexpr std::string_view default_font_folder = "/usr/share/fonts/truetype/dejavu";

/// Draws antialiased lines of text.
class Font {
public:
    /// @throws scene::EnvironmentError  naming the package, if there is no such font.
    explicit Font(const std::filesystem::path& file);

    /// Draws over the image; the baseline begins at (left, baseline).
    /// @param text  One line. Bytes that are not UTF-8 become "?"; trailing blanks are dropped.
    void draw(std::string_view text, int size_px, int left, int baseline, store::Rgb colour,
              store::RgbImage& image) const;
    /// Advance of the line [px].
    [[nodiscard]] int width_px(std::string_view text, int size_px) const;

private:
    struct Face;
    struct CloseFace {
        void operator()(Face* face) const;
    };
    std::unique_ptr<Face, CloseFace> face_;
};

/// The colours of backgrounds, texts and frames in all pictures.
struct PictureColours {
    static constexpr store::Rgb paper{0xFC, 0xFC, 0xFA};
    static constexpr store::Rgb ink{0x22, 0x22, 0x22};
    static constexpr store::Rgb faint_ink{0x66, 0x66, 0x66};
    static constexpr store::Rgb frame{0xC8, 0xC8, 0xC4};
};

struct TextStyle {
    int size_px = 16;
    bool bold = false;
    store::Rgb colour = PictureColours::ink;
};

/// An image to paste pictures, rectangles and text on.
class Canvas {
public:
    /// @throws scene::EnvironmentError  naming the package, if the fonts are not in the folder.
    Canvas(scene::ImageSize size, store::Rgb background, const std::filesystem::path& font_folder);

    void paste(const store::RgbImage& image, int left, int top);
    /// Fills the part of the rectangle that lies on the canvas.
    void fill(int left, int top, scene::ImageSize size, store::Rgb colour);
    /// Writes one line whose baseline starts at (left, baseline), as `Font::draw` does.
    void write(int left, int baseline, std::string_view text, const TextStyle& style);
    /// Advance of a line [px].
    [[nodiscard]] int text_width_px(std::string_view text, const TextStyle& style) const;
    /// The text, cut and ended by three dots if it is wider than the width.
    [[nodiscard]] std::string fitted(std::string_view text, const TextStyle& style,
                                     int width_px) const;

    /// The text in lines no wider than the width, broken at spaces. A word that is too wide, and a
    /// last line with more text to follow, are `fitted`.
    /// @param most_lines  At least 1.
    [[nodiscard]] std::vector<std::string> wrapped(std::string_view text, const TextStyle& style,
                                                   int width_px, std::size_t most_lines) const;

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
