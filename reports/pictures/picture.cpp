#include "reports/pictures/picture.hpp"

#include "analysis/advice/remedies.hpp"
#include "methods/job_method.hpp"
#include "reports/pictures/captions.hpp"
#include "reports/text/description.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

/// Lines that a long text may take.
constexpr std::size_t most_lines = 8;

/// A panel with its texts.
struct DrawnPanel {
    store::RgbImage image;
    Caption caption;
};

/// Writes text into a picture's columns.
class PictureWriter {
public:
    PictureWriter(Canvas& canvas, const PictureLayout& layout) : canvas_{canvas}, layout_{layout} {}

    /// The caption with its texts broken into lines as wide as a column.
    [[nodiscard]] Caption wrapped(const Caption& caption) const
    {
        Caption result{caption.title, {}};
        const auto add_plain = [&](std::string_view text) {
            for (std::string& line :
                 canvas_.wrapped(text, plain(), layout_.column_px, most_lines)) {
                result.lines.push_back({std::move(line), {}, {}, {}});
            }
        };
        for (const CaptionLine& line : caption.lines) {
            if (!line.mark) {
                add_plain(line.name);
            } else if (detail_offset_px() + canvas_.text_width_px(line.detail, plain()) <=
                       layout_.column_px) {
                result.lines.push_back(line);
            } else {
                result.lines.push_back({line.name, line.value, {}, line.mark});
                add_plain(line.detail);
            }
        }
        return result;
    }

    /// Writes a wrapped caption around the panel at (left, top).
    void write(const Caption& caption, int left, int top)
    {
        TextStyle title{layout_.font * 5 / 4, true, PictureColours::ink};
        if (canvas_.text_width_px(caption.title, title) > layout_.column_px) {
            title.size_px = layout_.font;
        }
        canvas_.write(left, top - layout_.line / 3,
                      canvas_.fitted(caption.title, title, layout_.column_px), title);
        int baseline = top + layout_.panel.height_px + layout_.line * 9 / 8;
        for (const CaptionLine& line : caption.lines) {
            line.mark ? write_marked(line, *line.mark, left, baseline)
                      : canvas_.write(left, baseline, line.name, plain());
            baseline += layout_.line;
        }
    }

private:
    [[nodiscard]] TextStyle plain() const { return {layout_.font, false, PictureColours::ink}; }
    [[nodiscard]] TextStyle bold() const { return {layout_.font, true, PictureColours::ink}; }
    [[nodiscard]] int swatch_px() const { return layout_.font * 4 / 5; }
    [[nodiscard]] int name_offset_px() const { return swatch_px() + layout_.font / 2; }
    [[nodiscard]] int value_end_px() const
    {
        return name_offset_px() + canvas_.text_width_px("indeterminate <0.0001 %", bold());
    }
    [[nodiscard]] int detail_offset_px() const { return value_end_px() + layout_.font * 2 / 3; }

    void write_marked(const CaptionLine& line, Mark mark, int left, int baseline)
    {
        const int side = swatch_px();
        canvas_.fill(left, baseline - side, {side, side}, mark_colour(mark));
        canvas_.write(left + name_offset_px(), baseline, line.name, plain());
        const int value_left = value_end_px() - canvas_.text_width_px(line.value, bold());
        canvas_.write(left + value_left, baseline, line.value, bold());
        canvas_.write(left + detail_offset_px(), baseline, line.detail, plain());
    }

    Canvas& canvas_;
    const PictureLayout& layout_;
};

/// "1280x720 pixels", or "pixels (400, 210) to (879, 479) of 1280x720"
std::string part_text(const ImagePart& part, scene::ImageSize image)
{
    return part.size == image
               ? fmt::format("{}x{} pixels", image.width_px, image.height_px)
               : fmt::format("pixels ({}, {}) to ({}, {}) of {}x{}", part.left, part.top,
                             part.left + part.size.width_px - 1, part.top + part.size.height_px - 1,
                             image.width_px, image.height_px);
}

/// What the picture shows, and from where.
std::vector<std::string> heading_texts(const analysis::Comparison& comparison,
                                       const ImagePart& part, scene::ImageSize panel)
{
    const Description words = describe(comparison);
    const std::string mesh = comparison.evaluation ? comparison.scene.name + ", " : std::string{};
    std::string pixels =
        fmt::format("{}{}; {}", mesh, words.size, part_text(part, comparison.view.image));
    if (panel.width_px < part.size.width_px) {
        pixels +=
            fmt::format(", shown at {}x{} with every error kept", panel.width_px, panel.height_px);
    }
    return {pixels, fmt::format("light {}; gnomon {}", words.light, comparison.environment.gnomon)};
}

/// A picture's texts and images, from which its layout follows.
class PictureParts {
public:
    PictureParts(const analysis::Comparison& comparison, const std::filesystem::path& font_folder)
        : comparison_{comparison},
          part_{shown_part(comparison.truth.pixel_class)},
          layout_{lay_out_picture(part_.size)}
    {
        draw();
        layout_ = lay_out_picture(part_.size, {static_cast<int>(panels_.size())});
        break_lines(font_folder);
    }

    [[nodiscard]] store::RgbImage on_canvas(const std::filesystem::path& font_folder) const
    {
        Canvas canvas{layout_.canvas, PictureColours::paper, font_folder};
        write_heading(canvas);
        PictureWriter writer{canvas, layout_};
        for (int i = 0; i < static_cast<int>(panels_.size()); ++i) {
            const auto& [image, caption] = panels_[static_cast<std::size_t>(i)];
            const int left = layout_.margin + i % layout_.columns * layout_.step_x;
            const int top = layout_.first_panel + i / layout_.columns * layout_.step_y;
            canvas.fill(left - 1, top - 1,
                        {layout_.panel.width_px + 2, layout_.panel.height_px + 2},
                        PictureColours::frame);
            canvas.paste(image, left, top);
            writer.write(caption, left, top);
        }
        return canvas.image();
    }

private:
    void draw()
    {
        Panels drawn = draw_panels(comparison_, layout_.panel, part_);
        panels_.push_back({std::move(drawn.gl), shown_caption(comparison_)});
        panels_.push_back({std::move(drawn.truth), truth_caption(comparison_)});
        panels_.push_back({std::move(drawn.errors), error_caption(comparison_.metrics)});
        if (const auto after = recommended_errors(comparison_)) {
            panels_.push_back({draw_errors(comparison_, after->verdicts, layout_.panel, part_),
                               after_caption(comparison_, *after->recommended)});
        }
    }

    /// Breaks the texts into lines, and makes room for them.
    void break_lines(const std::filesystem::path& font_folder)
    {
        Canvas canvas{{1, 1}, PictureColours::paper, font_folder};
        PictureContent content{static_cast<int>(panels_.size()), 0, 0};
        for (const std::string& text : heading_texts(comparison_, part_, layout_.panel)) {
            for (std::string& line :
                 canvas.wrapped(text, heading_style(), text_width_px(), most_lines)) {
                heading_.push_back(std::move(line));
            }
        }
        content.heading_lines = static_cast<int>(heading_.size());
        const PictureWriter writer{canvas, layout_};
        for (DrawnPanel& panel : panels_) {
            panel.caption = writer.wrapped(panel.caption);
            content.caption_lines =
                std::max(content.caption_lines, static_cast<int>(panel.caption.lines.size()));
        }
        layout_ = lay_out_picture(part_.size, content);
    }

    void write_heading(Canvas& canvas) const
    {
        const auto& evaluation = comparison_.evaluation;
        const TextStyle title{layout_.font * 3 / 2, true, PictureColours::ink};
        int baseline = layout_.margin + layout_.line;
        canvas.write(layout_.margin, baseline,
                     canvas.fitted(evaluation ? evaluation->case_name : comparison_.scene.name,
                                   title, text_width_px()),
                     title);
        for (const std::string& line : heading_) {
            baseline += layout_.line;
            canvas.write(layout_.margin, baseline, line, heading_style());
        }
    }

    [[nodiscard]] TextStyle heading_style() const
    {
        return {layout_.font, false, PictureColours::faint_ink};
    }
    [[nodiscard]] int text_width_px() const { return layout_.canvas.width_px - 2 * layout_.margin; }

    const analysis::Comparison& comparison_;
    ImagePart part_;
    PictureLayout layout_;
    std::vector<DrawnPanel> panels_;
    std::vector<std::string> heading_;
};

} // namespace

std::optional<RecommendedErrors> recommended_errors(const analysis::Comparison& comparison)
{
    const auto& diagnosis = comparison.diagnosis;
    if (!diagnosis || !diagnosis->biases || !diagnosis->curve.recommended ||
        has_fractions(comparison.metrics) || methods::traits(comparison.job).has_fractions()) {
        return std::nullopt;
    }
    const analysis::Recommendation& recommended = *diagnosis->curve.recommended;
    const std::uint64_t wrong = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    if (recommended.rounded_outcome.errors.total() >= wrong ||
        !analysis::keeps_shadows(comparison, recommended.rounded_outcome)) {
        return std::nullopt;
    }
    const scene::Image<float>& criticals = diagnosis->biases->critical_bias;
    RecommendedErrors after{&recommended, scene::Image<float>{criticals.size()}};
    for (std::size_t i = 0; i < criticals.pixel_count(); ++i) {
        after.verdicts[i] = criticals[i] <= recommended.rounded.bias ? 1.0F : 0.0F;
    }
    return after;
}

store::RgbImage draw_picture(const analysis::Comparison& comparison,
                             const std::filesystem::path& font_folder)
{
    return PictureParts{comparison, font_folder}.on_canvas(font_folder);
}

void write_picture(const std::filesystem::path& path, const analysis::Comparison& comparison)
{
    store::write_file(path, store::encode_png(draw_picture(comparison)));
}

} // namespace gnomon::reports
