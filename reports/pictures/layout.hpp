#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <utility>

namespace gnomon::reports {

/// A rectangle of an image's pixels.
struct ImagePart {
    int left = 0;
    int top = 0;
    scene::ImageSize size;

    friend bool operator==(const ImagePart&, const ImagePart&) = default;
};

/// The part of an image that a picture shows: the scored pixels with a margin, in the image's
/// shape. The whole image unless that part has at most half its area, or if no pixel is scored.
[[nodiscard]] ImagePart shown_part(const scene::Image<scene::PixelClass>& classes);

/// How much a picture holds beside its title.
struct PictureContent {
    int panels = 3;
    int heading_lines = 2; ///< below the title
    int caption_lines = 4; ///< of the longest caption
};

/// Positions of a picture's parts [px].
struct PictureLayout {
    scene::ImageSize canvas;
    scene::ImageSize panel;
    int columns = 3;     ///< of panels
    int column_px = 0;   ///< width of a panel's texts, at least that of the panel
    int font = 16;       ///< size of plain text
    int margin = 16;     ///< around everything, and between panels
    int line = 24;       ///< distance of baselines
    int first_panel = 0; ///< top of the first panel
    int step_x = 0;      ///< from one panel to the next
    int step_y = 0;
};

/// Stacks the panels of a wide part. Else puts three side by side, and four in two rows, or side by
/// side if the part is narrow.
/// @param shown  Size of the part of the image that each panel shows [px].
[[nodiscard]] PictureLayout lay_out_picture(scene::ImageSize shown,
                                            const PictureContent& content = {});

/// The pixels [first, last) of an image's side that pixel `index` covers when the side is scaled to
/// `shown_px`; at least one.
[[nodiscard]] std::pair<int, int> covered_pixels(int index, int shown_px, int image_px);

} // namespace gnomon::reports
