#pragma once

#include "analysis/comparison/comparison.hpp"
#include "reports/pictures/canvas.hpp"

#include <filesystem>

namespace gnomon::reports {

/// One labelled panel that a person reads at a glance: GL's shadows on the shaded scene, the true
/// ones, and the errors coloured by kind, each with its counts beneath.
///
/// The panels stand side by side, or one above the other if the image is wide. Large images are
/// scaled down to about 960 px a panel and small ones up by a whole factor; errors never vanish.
/// @throws scene::EnvironmentError  naming the package, if the font is missing.
[[nodiscard]] store::RgbImage
draw_picture(const analysis::Comparison& comparison,
             const std::filesystem::path& font_folder = default_font_folder);

/// Draws the picture into a PNG file.
/// @throws scene::EnvironmentError  if it cannot be drawn or written; what stood there then stays.
void write_picture(const std::filesystem::path& path, const analysis::Comparison& comparison);

/// Where the parts of a picture are [px].
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

} // namespace gnomon::reports
