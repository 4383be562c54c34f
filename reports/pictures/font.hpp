#pragma once

#include "store/images/png.hpp"

#include <filesystem>
#include <memory>
#include <string_view>

namespace gnomon::reports {

/// Draws lines of text, smoothed.
class Font {
public:
    /// @throws scene::EnvironmentError  naming the package, if there is no such font.
    explicit Font(const std::filesystem::path& file);

    /// Draws over the image; the baseline begins at (left, baseline).
    /// @param text  one line; bytes that are no UTF-8 become "?", blanks at its end are left out.
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

} // namespace gnomon::reports
