#include "reports/gate/new_pixels_picture.hpp"

#include "reports/pictures/picture.hpp"
#include "reports/text/text.hpp"
#include "scene/vec.hpp"
#include "store/images/layer_file.hpp"
#include "store/json_values.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

constexpr int magnification = 8;
/// If there are more new pixels, each is one panel pixel, not a dot.
constexpr std::size_t most_dots = 200;

struct MarkStyle {
    PixelChange mark;
    std::string_view name;
    store::Rgb colour;
};

/// New errors first: a panel pixel shows the first kind that it covers.
constexpr std::array<MarkStyle, 4> mark_styles{
    {{PixelChange::new_false_shadow, "new false shadow", {0xD5, 0x5E, 0x00}},
     {PixelChange::new_false_lit, "new false lit", {0x00, 0x72, 0xB2}},
     {PixelChange::wrong_before, "wrong before, too", {0x55, 0x55, 0x55}},
     {PixelChange::fixed, "right again", {0x00, 0x9E, 0x73}}}};

bool became_wrong(PixelChange mark)
{
    return mark == PixelChange::new_false_shadow || mark == PixelChange::new_false_lit;
}

std::size_t count_of(const scene::Image<PixelChange>& marks, PixelChange mark)
{
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), mark));
}

/// A rectangle of an image, without its right column and bottom row.
struct Part {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

/// The image pixels under one panel pixel.
/// @param all  The part of the image that the panel shows.
Part covered_part(const Part& all, scene::ImageSize panel, int x, int y)
{
    const auto span = [](int index, int first, int last, int side) {
        const auto [begin, end] = covered_pixels(index, side, last - first);
        return std::pair{first + begin, first + end};
    };
    const auto [left, right] = span(x, all.left, all.right, panel.width_px);
    const auto [top, bottom] = span(y, all.top, all.bottom, panel.height_px);
    return {left, top, right, bottom};
}

store::Rgb shown_colour(const NewPixelsPicture& picture, const Part& part)
{
    const MarkStyle* shown = nullptr;
    std::array<std::uint32_t, 3> sum{};
    std::uint32_t pixels = 0;
    for (int y = part.top; y < part.bottom; ++y) {
        for (int x = part.left; x < part.right; ++x) {
            const auto style =
                std::find_if(mark_styles.begin(), mark_styles.end(),
                             [&](const MarkStyle& one) { return one.mark == picture.marks(x, y); });
            if (style != mark_styles.end() && (shown == nullptr || style < shown)) {
                shown = style;
            }
            const store::Rgb ground = picture.ground(x, y);
            sum[0] += ground.r;
            sum[1] += ground.g;
            sum[2] += ground.b;
            ++pixels;
        }
    }
    const auto mean = [&](std::size_t i) { return static_cast<std::uint8_t>(sum[i] / pixels); };
    return shown != nullptr ? shown->colour : store::Rgb{mean(0), mean(1), mean(2)};
}

store::RgbImage drawn_part(const NewPixelsPicture& picture, const Part& part, scene::ImageSize size)
{
    store::RgbImage image{size};
    for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
            image(x, y) = shown_colour(picture, covered_part(part, size, x, y));
        }
    }
    return image;
}

/// Counts new wrong pixels in parts of one size, by a summed-area table.
class NewPixelSums {
public:
    NewPixelSums(const scene::Image<PixelChange>& marks, scene::ImageSize size)
        : size_{size},
          last_left_{marks.size().width_px - size.width_px},
          last_top_{marks.size().height_px - size.height_px},
          sums_{{marks.size().width_px + 1, marks.size().height_px + 1}}
    {
        for (int y = 0; y < marks.size().height_px; ++y) {
            for (int x = 0; x < marks.size().width_px; ++x) {
                sums_(x + 1, y + 1) = sums_(x, y + 1) + sums_(x + 1, y) - sums_(x, y) +
                                      (became_wrong(marks(x, y)) ? 1U : 0U);
            }
        }
    }

    /// The part with the most new wrong pixels; the middle one among equal neighbours.
    [[nodiscard]] Part densest() const
    {
        int best_left = 0;
        int best_top = 0;
        for (int top = 0; top <= last_top_; ++top) {
            for (int left = 0; left <= last_left_; ++left) {
                if (count(left, top) > count(best_left, best_top)) {
                    best_left = left;
                    best_top = top;
                }
            }
        }
        int right = best_left;
        while (right < last_left_ && count(right + 1, best_top) == count(best_left, best_top)) {
            ++right;
        }
        const int left = (best_left + right) / 2;
        int bottom = best_top;
        while (bottom < last_top_ && count(left, bottom + 1) == count(left, best_top)) {
            ++bottom;
        }
        const int top = (best_top + bottom) / 2;
        return {left, top, left + size_.width_px, top + size_.height_px};
    }

private:
    [[nodiscard]] std::uint32_t count(int left, int top) const
    {
        const int right = left + size_.width_px;
        const int bottom = top + size_.height_px;
        return sums_(right, bottom) + sums_(left, top) - sums_(left, bottom) - sums_(right, top);
    }

    scene::ImageSize size_;
    int last_left_;
    int last_top_;
    scene::Image<std::uint32_t> sums_;
};

/// Draws the picture's parts on a canvas.
class NewPixelsDrawing {
public:
    NewPixelsDrawing(const NewPixelsPicture& picture, const std::filesystem::path& font_folder)
        : picture_{picture},
          panel_{lay_out_picture(picture.marks.size()).panel},
          font_{std::max(14, panel_.width_px / 40)},
          margin_{font_ * 3 / 2},
          line_{font_ * 3 / 2},
          panel_top_{margin_ + line_ * (3 + static_cast<int>(picture.lines.size()))},
          canvas_{{3 * margin_ + 2 * panel_.width_px,
                   panel_top_ + panel_.height_px + 4 * line_ + margin_ / 2},
                  PictureColours::paper,
                  font_folder}
    {
    }

    [[nodiscard]] store::RgbImage draw()
    {
        write_heading();
        const auto [width_px, height_px] = picture_.marks.size();
        const Part all{0, 0, width_px, height_px};
        const scene::ImageSize detail{std::clamp(panel_.width_px / magnification, 1, width_px),
                                      std::clamp(panel_.height_px / magnification, 1, height_px)};
        const Part part = NewPixelSums{picture_.marks, detail}.densest();
        const int right_left = 2 * margin_ + panel_.width_px;
        draw_panel(margin_, all, fmt::format("whole image, {}x{} pixels", width_px, height_px));
        if (new_pixels() <= most_dots) {
            draw_dots();
        }
        outline(part);
        draw_panel(right_left, part,
                   fmt::format("pixels ({}, {}) to ({}, {}), where most are new", part.left,
                               part.top, part.right - 1, part.bottom - 1));
        write_legend();
        return canvas_.image();
    }

private:
    void write_heading()
    {
        const int width_px = canvas_.image().size().width_px - 2 * margin_;
        const TextStyle title{font_ * 3 / 2, true, PictureColours::ink};
        const TextStyle plain{font_, false, PictureColours::faint_ink};
        int baseline = margin_ + line_;
        canvas_.write(margin_, baseline, canvas_.fitted(picture_.title, title, width_px), title);
        for (const std::string& text : picture_.lines) {
            baseline += line_;
            canvas_.write(margin_, baseline, canvas_.fitted(text, plain, width_px), plain);
        }
    }

    void draw_panel(int left, const Part& part, const std::string& caption)
    {
        const TextStyle style{font_, true, PictureColours::ink};
        canvas_.write(left, panel_top_ - line_ / 3, canvas_.fitted(caption, style, panel_.width_px),
                      style);
        canvas_.fill(left - 1, panel_top_ - 1, {panel_.width_px + 2, panel_.height_px + 2},
                     PictureColours::frame);
        canvas_.paste(drawn_part(picture_, part, panel_), left, panel_top_);
    }

    [[nodiscard]] std::size_t new_pixels() const
    {
        return count_of(picture_.marks, PixelChange::new_false_shadow) +
               count_of(picture_.marks, PixelChange::new_false_lit);
    }

    /// Draws each new wrong pixel as a dot in the whole image: single pixels are easily overlooked.
    void draw_dots()
    {
        const auto [width_px, height_px] = picture_.marks.size();
        const int radius = std::max(2, panel_.width_px / 250);
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) {
                if (!became_wrong(picture_.marks(x, y))) {
                    continue;
                }
                const int left = (2 * x + 1) * panel_.width_px / (2 * width_px) - radius;
                const int top = (2 * y + 1) * panel_.height_px / (2 * height_px) - radius;
                const int side = 2 * radius + 1;
                const int clipped_left = std::clamp(left, 0, panel_.width_px - side);
                const int clipped_top = std::clamp(top, 0, panel_.height_px - side);
                canvas_.fill(
                    margin_ + clipped_left, panel_top_ + clipped_top, {side, side},
                    mark_styles[picture_.marks(x, y) == PixelChange::new_false_lit ? 1 : 0].colour);
            }
        }
    }

    /// Outlines the magnified part in the whole image.
    void outline(const Part& part)
    {
        constexpr int thick = 2;
        const auto [width_px, height_px] = picture_.marks.size();
        const auto at_x = [&](int x) { return margin_ + x * panel_.width_px / width_px; };
        const auto at_y = [&](int y) { return panel_top_ + y * panel_.height_px / height_px; };
        // Drawn around the part, so that none of its pixels is covered.
        const int left = at_x(part.left) - thick;
        const int top = at_y(part.top) - thick;
        const int width = at_x(part.right) + thick - left;
        const int height = at_y(part.bottom) + thick - top;
        canvas_.fill(left, top, {width, thick}, PictureColours::ink);
        canvas_.fill(left, top + height - thick, {width, thick}, PictureColours::ink);
        canvas_.fill(left, top, {thick, height}, PictureColours::ink);
        canvas_.fill(left + width - thick, top, {thick, height}, PictureColours::ink);
    }

    void write_legend()
    {
        const TextStyle plain{font_, false, PictureColours::ink};
        const TextStyle bold{font_, true, PictureColours::ink};
        const int side = font_ * 4 / 5;
        for (std::size_t i = 0; i < mark_styles.size(); ++i) {
            const MarkStyle& style = mark_styles[i];
            const int left = margin_ + (i < 2 ? 0 : margin_ + panel_.width_px);
            const int baseline =
                panel_top_ + panel_.height_px + line_ * (3 + 2 * static_cast<int>(i % 2)) / 2;
            canvas_.fill(left, baseline - side, {side, side}, style.colour);
            const std::string count = grouped(count_of(picture_.marks, style.mark));
            const int number_left = left + side + font_ / 2;
            canvas_.write(number_left, baseline, count, bold);
            canvas_.write(number_left + canvas_.text_width_px(count, bold) + font_ / 3, baseline,
                          style.name, plain);
        }
    }

    const NewPixelsPicture& picture_;
    scene::ImageSize panel_;
    int font_;
    int margin_;
    int line_;
    int panel_top_;
    Canvas canvas_;
};

/// A surface's grey, shaded by a light above the viewer's shoulder.
store::Rgb ground_colour(const scene::Vec3f& normal, scene::PixelClass pixel_class)
{
    if (!std::isfinite(normal.x) || pixel_class == scene::PixelClass::background) {
        return {0xF4, 0xF4, 0xF2};
    }
    const scene::Vec3f positional = glm::normalize(scene::Vec3f{0.35F, 0.8F, 0.5F});
    const float facing = 0.5F + 0.5F * glm::dot(normal, positional);
    const float light = scene::is_lit(pixel_class) ? 1.0F : 0.86F;
    const float grey = (0.70F + 0.24F * facing) * light;
    const auto value = static_cast<std::uint8_t>(std::lround(255 * std::clamp(grey, 0.0F, 1.0F)));
    return {value, value, value};
}

} // namespace

store::RgbImage draw_new_pixels_picture(const NewPixelsPicture& picture,
                                        const std::filesystem::path& font_folder)
{
    return NewPixelsDrawing{picture, font_folder}.draw();
}

store::RgbImage draw_marks(const NewPixelsPicture& picture, scene::ImageSize size)
{
    const auto [width_px, height_px] = picture.marks.size();
    return drawn_part(picture, {0, 0, width_px, height_px}, size);
}

store::RgbImage shaded_ground(const std::filesystem::path& run, const std::string& id)
{
    store::LayerFile file{store::pixels_path(run, id), "compute the run's pixels again"};
    const auto classes = file.classes();
    store::RgbImage ground{classes.size()};
    const bool has_normals = file.has("N.X") && file.has("N.Y") && file.has("N.Z");
    const scene::Image<float> flat{classes.size(), 0.5F};
    const auto x = has_normals ? file.floats("N.X") : flat;
    const auto y = has_normals ? file.floats("N.Y") : flat;
    const auto z = has_normals ? file.floats("N.Z") : flat;
    for (std::size_t i = 0; i < ground.pixel_count(); ++i) {
        ground[i] = ground_colour({x[i], y[i], z[i]}, classes[i]);
    }
    return ground;
}

} // namespace gnomon::reports
