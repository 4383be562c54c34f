#include "reports/pictures/layout.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gnomon::reports {

namespace {

constexpr int largest_panel_px = 960;
constexpr int smallest_panel_px = 480;
/// Wider images are stacked, as they would be too narrow side by side.
constexpr double widest_aspect = 2.5;
/// Two rows of narrower images would be too high.
constexpr double narrowest_aspect = 2.0 / 3;
/// Margin around the scored pixels, as a share of their longer side.
constexpr double part_margin = 0.06;
/// Smaller parts would show too little of their surroundings; a share of the image's sides.
constexpr double smallest_part = 0.125;

/// The panel's size for an image: at most 960 px wide and high, small images by a whole factor.
scene::ImageSize panel_size(scene::ImageSize image)
{
    const int longest = std::max(image.width_px, image.height_px);
    if (longest > largest_panel_px) {
        const auto scaled = [&](int side_px) {
            const std::int64_t product = static_cast<std::int64_t>(side_px) * largest_panel_px;
            return std::max(1, static_cast<int>(product / longest));
        };
        return {scaled(image.width_px), scaled(image.height_px)};
    }
    const int factor =
        std::max(1, std::min((smallest_panel_px + image.width_px - 1) / image.width_px,
                             largest_panel_px / longest));
    return {image.width_px * factor, image.height_px * factor};
}

int columns_of(scene::ImageSize shown, int panels)
{
    const double aspect = static_cast<double>(shown.width_px) / shown.height_px;
    if (aspect > widest_aspect) {
        return 1;
    }
    return panels == 4 && aspect >= narrowest_aspect ? 2 : panels;
}

/// The scored pixels' columns and rows, each [first, last).
struct Bounds {
    int left;
    int right = 0;
    int top;
    int bottom = 0;

    explicit Bounds(const scene::Image<scene::PixelClass>& classes)
        : left{classes.size().width_px},
          top{classes.size().height_px}
    {
        for (int y = 0; y < classes.size().height_px; ++y) {
            for (int x = 0; x < classes.size().width_px; ++x) {
                if (scene::is_scored(classes(x, y))) {
                    left = std::min(left, x);
                    right = std::max(right, x + 1);
                    top = std::min(top, y);
                    bottom = y + 1;
                }
            }
        }
    }

    [[nodiscard]] bool is_empty() const { return right == 0; }
};

/// The start of a range of `size_px` around the middle of [first, last), inside [0, image_px).
int centred(int first, int last, int size_px, int image_px)
{
    return std::clamp((first + last - size_px) / 2, 0, image_px - size_px);
}

} // namespace

ImagePart shown_part(const scene::Image<scene::PixelClass>& classes)
{
    const scene::ImageSize image = classes.size();
    const ImagePart whole{0, 0, image};
    const Bounds scored{classes};
    if (scored.is_empty()) {
        return whole;
    }
    const int width_px = scored.right - scored.left;
    const int height_px = scored.bottom - scored.top;
    const double grown_px = 2 * std::ceil(part_margin * std::max(width_px, height_px));
    const double share = std::clamp(
        std::max((width_px + grown_px) / image.width_px, (height_px + grown_px) / image.height_px),
        smallest_part, 1.0);
    const auto side = [&](int side_px) { return static_cast<int>(std::ceil(share * side_px)); };
    const scene::ImageSize size{side(image.width_px), side(image.height_px)};
    if (2 * size.pixel_count() > image.pixel_count()) {
        return whole;
    }
    return {centred(scored.left, scored.right, size.width_px, image.width_px),
            centred(scored.top, scored.bottom, size.height_px, image.height_px), size};
}

PictureLayout lay_out_picture(scene::ImageSize shown, const PictureContent& content)
{
    PictureLayout layout;
    layout.panel = panel_size(shown);
    layout.columns = columns_of(shown, content.panels);
    // The captions of a tall, narrow panel need more width than it has.
    layout.column_px = std::max(layout.panel.width_px, smallest_panel_px);
    layout.font = std::max(14, layout.column_px / 30);
    layout.line = layout.font * 3 / 2;
    layout.margin = layout.font * 3 / 2;
    layout.first_panel =
        layout.margin + (3 + content.heading_lines) * layout.line + layout.line / 4;
    const int block_px = layout.panel.height_px + (content.caption_lines + 1) * layout.line;
    const int rows = (content.panels + layout.columns - 1) / layout.columns;
    layout.step_x = layout.column_px + layout.margin;
    layout.step_y = block_px + 2 * layout.line;
    layout.canvas = {2 * layout.margin + layout.column_px + (layout.columns - 1) * layout.step_x,
                     layout.first_panel + block_px + (rows - 1) * layout.step_y +
                         layout.margin / 2};
    return layout;
}

std::pair<int, int> covered_pixels(int index, int shown_px, int image_px)
{
    const auto edge = [&](int at) {
        return static_cast<int>(static_cast<std::int64_t>(at) * image_px / shown_px);
    };
    return {edge(index), std::max(edge(index) + 1, edge(index + 1))};
}

} // namespace gnomon::reports
