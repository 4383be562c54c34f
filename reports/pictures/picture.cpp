#include "reports/pictures/picture.hpp"

#include "methods/job_method.hpp"
#include "reports/text/description.hpp"
#include "reports/text/text.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

using scene::PixelClass;

constexpr int largest_panel_px = 960;
constexpr int smallest_panel_px = 480;
/// Wider images are stacked, as they would be too narrow side by side.
constexpr double widest_aspect = 2.5;
constexpr int caption_lines = 4;

/// A line below a panel: an optional swatch, a name, a rate and its counts.
struct CaptionLine {
    std::string name;
    std::string value;
    std::string detail;
    std::optional<Mark> mark;
};

struct Caption {
    std::string title;
    std::vector<CaptionLine> lines;
};

Caption gl_caption(const analysis::Comparison& comparison)
{
    const Description words = describe(comparison);
    if (!methods::traits(comparison.job).has_map) {
        return {"GL shadows",
                {{words.lookup, {}, {}, {}}, {comparison.environment.gl_renderer, {}, {}, {}}}};
    }
    return {"GL shadow map",
            {{words.map + ", " + words.lookup, {}, {}, {}},
             {"bias " + words.bias, {}, {}, {}},
             {words.range, {}, {}, {}},
             {comparison.environment.gl_renderer, {}, {}, {}}}};
}

/// "resolution = 1024, depth_format = d32f": the keys of a table that the case gives.
std::string given_settings(const analysis::Comparison& comparison,
                           const std::vector<std::string>& given, std::string_view table)
{
    std::string text;
    for (const auto& [key, value] : scene::resolved_keys(comparison.job)) {
        if (key.starts_with(table) && std::ranges::find(given, key) != given.end()) {
            text +=
                fmt::format("{}{} = {}", text.empty() ? "" : ", ", key.substr(table.size()), value);
        }
    }
    return text;
}

/// Another renderer's name, and its case's map settings.
Caption case_caption(const analysis::Comparison& comparison, const analysis::Evaluation& evaluation)
{
    Caption caption{comparison.environment.gl_renderer, {}};
    for (const auto& [name, table] :
         {std::pair{"map", "shadow_map."}, {"lookup", "lookup."}, {"bias", "bias."}}) {
        const std::string text = given_settings(comparison, evaluation.given_keys, table);
        if (!text.empty()) {
            caption.lines.push_back({fmt::format("{} {}", name, text), {}, {}, {}});
        }
    }
    if (caption.lines.empty()) {
        caption.lines.push_back({"the case gives no settings of a shadow map", {}, {}, {}});
    }
    return caption;
}

Caption shown_caption(const analysis::Comparison& comparison)
{
    return comparison.evaluation ? case_caption(comparison, *comparison.evaluation)
                                 : gl_caption(comparison);
}

Caption truth_caption(const analysis::Comparison& comparison)
{
    const analysis::ClassCounts& counts = comparison.metrics.pixels;
    const auto pixels = [&](PixelClass pixel_class) { return grouped(counts.of(pixel_class)); };
    return {
        "Truth (shadow rays)",
        {{fmt::format("{} lit, {} blocked", pixels(PixelClass::lit), pixels(PixelClass::blocked)),
          {},
          {},
          {}},
         {fmt::format("{} attached (turned from the light)", pixels(PixelClass::attached)),
          {},
          {},
          {}},
         {fmt::format("{} outside the light, {} background", pixels(PixelClass::out_of_light),
                      pixels(PixelClass::background)),
          {},
          {},
          {}},
         {fmt::format("{}, {}", comparison.environment.embree, comparison.truth_method),
          {},
          {},
          {}}}};
}

Caption error_caption(const analysis::Metrics& metrics)
{
    const analysis::ClassCounts& counts = metrics.pixels;
    const auto of_scored = [](std::uint64_t part, std::uint64_t whole, std::string_view noun) {
        return fmt::format("{} of {} {}", grouped(part), grouped(whole), noun);
    };
    return {
        has_fractions(metrics)
            ? fmt::format("Errors: {} wrong, {} by amount", percent(metrics.error_rate),
                          percent(metrics.mean_abs_error))
            : fmt::format("Errors: {} of scored pixels", percent(metrics.error_rate)),
        {{"false shadow", percent(metrics.false_shadow_rate),
          of_scored(metrics.false_shadow, counts.of(PixelClass::lit), "lit"), Mark::false_shadow},
         {"false lit", percent(metrics.false_lit_rate),
          of_scored(metrics.false_lit, counts.of(PixelClass::blocked), "blocked"), Mark::false_lit},
         {"unmatched",
          {},
          fmt::format("{}, not scored", grouped(counts.of(PixelClass::unmatched))),
          Mark::unmatched},
         {"indeterminate",
          {},
          fmt::format("{}, not scored", grouped(counts.of(PixelClass::indeterminate))),
          Mark::indeterminate}}};
}

/// Writes the texts of one panel.
class CaptionWriter {
public:
    CaptionWriter(Canvas& canvas, const PictureLayout& layout, int left, int top)
        : canvas_{canvas},
          layout_{layout},
          left_{left},
          top_{top}
    {
    }

    void write(const Caption& caption)
    {
        const TextStyle title{layout_.font * 5 / 4, true, PictureColours::ink};
        canvas_.write(left_, top_ - layout_.line / 3,
                      canvas_.fitted(caption.title, title, layout_.panel.width_px), title);
        int baseline = top_ + layout_.panel.height_px + layout_.line * 9 / 8;
        for (const CaptionLine& line : caption.lines) {
            line.mark ? write_marked(line, *line.mark, baseline) : write_plain(line, baseline);
            baseline += layout_.line;
        }
    }

private:
    void write_plain(const CaptionLine& line, int baseline)
    {
        const TextStyle style{layout_.font, false, PictureColours::ink};
        canvas_.write(left_, baseline, canvas_.fitted(line.name, style, layout_.panel.width_px),
                      style);
    }

    void write_marked(const CaptionLine& line, Mark mark, int baseline)
    {
        const TextStyle bold{layout_.font, true, PictureColours::ink};
        const TextStyle plain{layout_.font, false, PictureColours::ink};
        const int side = layout_.font * 4 / 5;
        canvas_.fill(left_, baseline - side, {side, side}, mark_colour(mark));
        const int name_left = left_ + side + layout_.font / 2;
        canvas_.write(name_left, baseline, line.name, plain);
        const int value_right = name_left + canvas_.text_width_px("indeterminate <0.0001 %", bold);
        canvas_.write(value_right - canvas_.text_width_px(line.value, bold), baseline, line.value,
                      bold);
        const int detail_left = value_right + layout_.font * 2 / 3;
        canvas_.write(
            detail_left, baseline,
            canvas_.fitted(line.detail, plain, left_ + layout_.panel.width_px - detail_left),
            plain);
    }

    Canvas& canvas_;
    const PictureLayout& layout_;
    int left_;
    int top_;
};

void write_heading(Canvas& canvas, const PictureLayout& layout,
                   const analysis::Comparison& comparison)
{
    const Description words = describe(comparison);
    const scene::ImageSize image = comparison.view.image;
    const auto& evaluation = comparison.evaluation;
    const std::string mesh = evaluation ? comparison.scene.name + ", " : std::string{};
    std::string pixels = fmt::format("{}{}; {} pixels", mesh, words.size, words.image);
    if (layout.panel.width_px < image.width_px) {
        pixels += fmt::format(", shown at {}x{} with every error kept", layout.panel.width_px,
                              layout.panel.height_px);
    }
    const TextStyle title{layout.font * 3 / 2, true, PictureColours::ink};
    const TextStyle plain{layout.font, false, PictureColours::faint_ink};
    int baseline = layout.margin + layout.line;
    const auto write_line = [&](std::string_view text, const TextStyle& style) {
        const int width_px = layout.canvas.width_px - 2 * layout.margin;
        canvas.write(layout.margin, baseline, canvas.fitted(text, style, width_px), style);
        baseline += layout.line;
    };
    write_line(evaluation ? evaluation->case_name : comparison.scene.name, title);
    write_line(pixels, plain);
    write_line(fmt::format("light {}; gnomon {}", words.light, comparison.environment.gnomon),
               plain);
}

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

} // namespace

std::pair<int, int> covered_pixels(int index, int shown_px, int image_px)
{
    const auto edge = [&](int at) {
        return static_cast<int>(static_cast<std::int64_t>(at) * image_px / shown_px);
    };
    return {edge(index), std::max(edge(index) + 1, edge(index + 1))};
}

PictureLayout lay_out_picture(scene::ImageSize image)
{
    PictureLayout layout;
    layout.panel = panel_size(image);
    layout.is_stacked = image.width_px > widest_aspect * image.height_px;
    // The captions of a tall, narrow panel need more width than it has.
    const int column_px = std::max(layout.panel.width_px, smallest_panel_px);
    layout.font = std::max(14, column_px / 30);
    layout.line = layout.font * 3 / 2;
    layout.margin = layout.font * 3 / 2;
    layout.first_panel = layout.margin + 5 * layout.line + layout.line / 4;
    const int block_px = layout.panel.height_px + (caption_lines + 1) * layout.line;
    layout.step_x = layout.is_stacked ? 0 : column_px + layout.margin;
    layout.step_y = layout.is_stacked ? block_px + 2 * layout.line : 0;
    layout.canvas = {2 * layout.margin + column_px + 2 * layout.step_x,
                     layout.first_panel + block_px + 2 * layout.step_y + layout.margin / 2};
    return layout;
}

store::RgbImage draw_picture(const analysis::Comparison& comparison,
                             const std::filesystem::path& font_folder)
{
    const PictureLayout layout = lay_out_picture(comparison.view.image);
    Canvas canvas{layout.canvas, PictureColours::paper, font_folder};
    const Panels panels = draw_panels(comparison, layout.panel);
    const std::array images{&panels.gl, &panels.truth, &panels.errors};
    const std::array captions{shown_caption(comparison), truth_caption(comparison),
                              error_caption(comparison.metrics)};
    write_heading(canvas, layout, comparison);
    for (int i = 0; i < 3; ++i) {
        const int left = layout.margin + i * layout.step_x;
        const int top = layout.first_panel + i * layout.step_y;
        canvas.fill(left - 1, top - 1, {layout.panel.width_px + 2, layout.panel.height_px + 2},
                    PictureColours::frame);
        canvas.paste(*images[static_cast<std::size_t>(i)], left, top);
        CaptionWriter{canvas, layout, left, top}.write(captions[static_cast<std::size_t>(i)]);
    }
    return canvas.image();
}

void write_picture(const std::filesystem::path& path, const analysis::Comparison& comparison)
{
    store::write_file(path, store::encode_png(draw_picture(comparison)));
}

} // namespace gnomon::reports
