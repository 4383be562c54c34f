#pragma once

#include "analysis/comparison/comparison.hpp"
#include "reports/pictures/canvas.hpp"
#include "store/images/png.hpp"

#include <cstdint>
#include <filesystem>
#include <utility>

namespace gnomon::store {
class LayerFile;
} // namespace gnomon::store

namespace gnomon::reports {

/// A picture to read at a glance: three panels with GL's shadows on the shaded scene, the true
/// shadows, and the errors coloured by kind, each with its counts below.
///
/// Panels stand side by side, or stacked if the image is wide. Large images are scaled down to
/// about 960 px per panel and small ones up by a whole factor; every error stays visible.
/// @throws scene::EnvironmentError  naming the package, if the font is missing.
[[nodiscard]] store::RgbImage
draw_picture(const analysis::Comparison& comparison,
             const std::filesystem::path& font_folder = default_font_folder);

/// Draws the picture into a PNG file.
/// @throws scene::EnvironmentError  if it cannot be drawn or written; an older file then stays.
void write_picture(const std::filesystem::path& path, const analysis::Comparison& comparison);

/// Positions of a picture's parts [px].
struct PictureLayout {
    scene::ImageSize canvas;
    scene::ImageSize panel;
    bool is_stacked = false;
    int font = 16;       ///< size of plain text
    int margin = 16;     ///< around everything, and between panels
    int line = 24;       ///< distance of baselines
    int first_panel = 0; ///< top of the first panel
    int step_x = 0;      ///< from one panel to the next
    int step_y = 0;
};

[[nodiscard]] PictureLayout lay_out_picture(scene::ImageSize image);

/// The pixels [first, last) of an image's side that pixel `index` covers when the side is scaled to
/// `shown_px`; at least one.
[[nodiscard]] std::pair<int, int> covered_pixels(int index, int shown_px, int image_px);

/// A pixel's mark in the error panel.
enum class Mark : std::uint8_t { none, indeterminate, unmatched, false_shadow, false_lit };

/// `none` for correct scored pixels, `background`, `attached` and `out_of_light`.
[[nodiscard]] Mark mark_of(scene::PixelClass pixel_class, float verdict);

/// Okabe and Ito's colours, which are distinct for any colour vision.
/// Source: Okabe & Ito, "Color Universal Design", 2008.
[[nodiscard]] store::Rgb mark_colour(Mark mark);

/// Three panels of the same view and size.
struct Panels {
    store::RgbImage gl;     ///< shaded, with the shadow map's shadows
    store::RgbImage truth;  ///< shaded, with the true shadows
    store::RgbImage errors; ///< the faded truth with marks on top
};

/// Shades the scene (geometric normal, soft ambient and diffuse light) and scales it to `size`.
///
/// Shading is averaged over the pixels that a panel pixel covers, but marks are not. A panel pixel
/// that covers any error shows the more frequent kind, else any other mark, so that no error
/// vanishes. Elsewhere, verdicts that are off by less than one half tint it in proportion.
/// @param size  Of each panel; at least 1 px each way.
[[nodiscard]] Panels draw_panels(const analysis::Comparison& comparison, scene::ImageSize size);

/// As above, from the layers of `write_aov`. They lack the direction to the eye, so its faint light
/// is the same everywhere.
/// @throws scene::InputError  as `LayerFile` does.
[[nodiscard]] Panels draw_panels(store::LayerFile& layers, scene::ImageSize size);

} // namespace gnomon::reports
