#include "reports/pictures/heat_map.hpp"

#include "analysis/causes/cause.hpp"
#include "methods/job_method.hpp"
#include "reports/pictures/layout.hpp"
#include "reports/text/description.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "store/images/png.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace gnomon::reports {

namespace {

constexpr store::Rgb no_value{0xE9, 0xE9, 0xE7};
constexpr store::Rgb no_error{0xFA, 0xFA, 0xF8};

constexpr std::array<std::pair<std::string_view, HeatMap>, 5> kinds{
    std::pair{"needed-bias", HeatMap::needed_bias},
    {"depth-error", HeatMap::depth_error},
    {"amount", HeatMap::amount},
    {"cause", HeatMap::cause},
    {"label", HeatMap::label}};

/// From blue over white to vermilion: lightness shows the magnitude, hue the sign.
constexpr std::array<store::Rgb, 9> diverging{{{0x08, 0x30, 0x6B},
                                               {0x00, 0x72, 0xB2},
                                               {0x6B, 0xAE, 0xD6},
                                               {0xC6, 0xDB, 0xEF},
                                               {0xFA, 0xFA, 0xF8},
                                               {0xFB, 0xD3, 0xB4},
                                               {0xF0, 0x9A, 0x5C},
                                               {0xD5, 0x5E, 0x00},
                                               {0x7A, 0x2E, 0x00}}};

// Indexed by cause and label; pages and figures use the same colours. They are Okabe and Ito's, and
// for labels some of Tol's, so that no colour means both a cause and a label.
constexpr std::array<store::Rgb, 6> cause_colours{{no_error,
                                                   {0xE6, 0x9F, 0x00},
                                                   {0x00, 0x9E, 0x73},
                                                   {0x56, 0xB4, 0xE9},
                                                   {0xCC, 0x79, 0xA7},
                                                   {0x00, 0x72, 0xB2}}};
constexpr std::array<store::Rgb, 7> label_colours{{no_error,
                                                   {0xD5, 0x5E, 0x00},
                                                   {0x33, 0x22, 0x88},
                                                   {0x00, 0x00, 0x00},
                                                   {0x88, 0x22, 0x55},
                                                   {0xF0, 0xE4, 0x42},
                                                   {0x8C, 0x8C, 0x8C}}};

/// A scale from values to colours.
struct ColourScale {
    std::string_view title;
    std::string_view unit;
    double linear = 0;
    double largest = 0;
};

ColourScale scale_of(HeatMap kind)
{
    if (kind == HeatMap::needed_bias) {
        return {"Bias that lit pixels need and shadowed ones allow", "texels", 0.01, 100};
    }
    if (kind == HeatMap::amount) {
        return {"By how much verdicts are wrong: too dark above 0, too bright below",
                "truth minus verdict", 1, 1};
    }
    return {"Depth error of the shadow map, stored minus exact", "m", 1e-6, 1};
}

store::Rgb diverging_colour(double share)
{
    const double place = std::clamp(share, 0.0, 1.0) * (diverging.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(place), diverging.size() - 2);
    const double part = place - static_cast<double>(first);
    const auto mix = [&](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround(a + (b - a) * part));
    };
    const store::Rgb& a = diverging[first];
    const store::Rgb& b = diverging[first + 1];
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

/// Each pixel's value on the scale, or its colour's index; NaN for none.
scene::Image<float> values_of(const analysis::Comparison& comparison, HeatMap kind)
{
    if (!comparison.diagnosis) {
        throw scene::InputError("--heat-map and --truth float are mutually exclusive: --truth "
                                "float finds no causes and no biases");
    }
    const analysis::Diagnosis& diagnosis = *comparison.diagnosis;
    if (kind == HeatMap::needed_bias) {
        if (!diagnosis.biases) {
            throw scene::InputError("--heat-map needed-bias: this lookup has no bias curve: "
                                    "use amount, cause or label");
        }
        return diagnosis.biases->map.texels;
    }
    if (kind == HeatMap::depth_error) {
        if (!methods::traits(comparison.job).has_map) {
            throw scene::InputError("--heat-map depth-error: this lookup has no map: use amount, "
                                    "cause or label");
        }
        return diagnosis.map_error_m;
    }
    const auto& classes = comparison.truth.pixel_class;
    scene::Image<float> values{classes.size(), std::numeric_limits<float>::quiet_NaN()};
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (!scene::is_scored(classes[i])) {
            continue;
        }
        if (kind == HeatMap::amount) {
            const auto [too_dark, too_bright] =
                scene::error_of(comparison.truth.share(i), comparison.lookup.samples[i].verdict);
            values[i] = static_cast<float>(too_dark - too_bright);
        } else {
            values[i] = kind == HeatMap::cause ? static_cast<float>(diagnosis.causes.cause[i])
                                               : static_cast<float>(diagnosis.causes.label[i]);
        }
    }
    return values;
}

store::Rgb colour_of(float value, HeatMap kind)
{
    if (std::isnan(value)) {
        return no_value;
    }
    if (kind == HeatMap::cause) {
        return cause_colours.at(static_cast<std::size_t>(value));
    }
    if (kind == HeatMap::label) {
        return label_colours.at(static_cast<std::size_t>(value));
    }
    const ColourScale scale = scale_of(kind);
    return diverging_colour(share_on_scale(value, scale.linear, scale.largest));
}

/// The value of the largest magnitude in a rectangle; NaN if it has none.
float largest_in(const scene::Image<float>& values, std::pair<int, int> xs, std::pair<int, int> ys)
{
    float largest = std::numeric_limits<float>::quiet_NaN();
    for (int y = ys.first; y < ys.second; ++y) {
        for (int x = xs.first; x < xs.second; ++x) {
            const float value = values(x, y);
            if (std::isnan(largest) || std::abs(value) > std::abs(largest)) {
                largest = value;
            }
        }
    }
    return largest;
}

store::RgbImage coloured(const scene::Image<float>& values, HeatMap kind, scene::ImageSize shown)
{
    store::RgbImage image{shown};
    for (int y = 0; y < shown.height_px; ++y) {
        const auto ys = covered_pixels(y, shown.height_px, values.size().height_px);
        for (int x = 0; x < shown.width_px; ++x) {
            const auto xs = covered_pixels(x, shown.width_px, values.size().width_px);
            image(x, y) = colour_of(largest_in(values, xs, ys), kind);
        }
    }
    return image;
}

/// Draws legends from left to right below the image.
class LegendWriter {
public:
    LegendWriter(Canvas& canvas, const PictureLayout& layout, int top)
        : canvas_{canvas},
          layout_{layout},
          left_{layout.margin},
          top_{top}
    {
    }

    /// Draws a colour bar with ticks and unit.
    void write_scale(const ColourScale& scale)
    {
        const int width_px = layout_.panel.width_px * 7 / 10;
        for (int x = 0; x < width_px; ++x) {
            const double share = (x + 0.5) / width_px;
            canvas_.fill(left_ + x, top_, {1, layout_.font}, diverging_colour(share));
        }
        std::vector<double> ticks{0};
        for (double tick = scale.largest; tick > scale.linear / 2; tick /= 100) {
            ticks.insert(ticks.end(), {tick, -tick});
        }
        for (const double tick : ticks) {
            const double share = share_on_scale(tick, scale.linear, scale.largest);
            write_tick(left_ + static_cast<int>(std::lround(share * width_px)),
                       fmt::format("{:g}", tick));
        }
        left_ += width_px + layout_.font;
        write_text(std::string{scale.unit});
        left_ += layout_.font;
    }

    void write_swatch(store::Rgb colour, const std::string& name)
    {
        const int side = layout_.font;
        canvas_.fill(left_, top_, {side, side}, PictureColours::faint_ink);
        canvas_.fill(left_ + 1, top_ + 1, {side - 2, side - 2}, colour);
        left_ += side + layout_.font / 2;
        write_text(name);
        left_ += layout_.font;
    }

private:
    void write_text(const std::string& text)
    {
        const TextStyle style{layout_.font, false, PictureColours::ink};
        canvas_.write(left_, top_ + layout_.font * 9 / 10, text, style);
        left_ += canvas_.text_width_px(text, style);
    }
    void write_tick(int x, const std::string& text)
    {
        const TextStyle style{layout_.font * 7 / 8, false, PictureColours::ink};
        canvas_.fill(x, top_ + layout_.font, {1, layout_.font / 3}, PictureColours::ink);
        const int width_px = canvas_.text_width_px(text, style);
        canvas_.write(std::max(layout_.margin, x - width_px / 2), top_ + layout_.font * 9 / 4, text,
                      style);
    }

    Canvas& canvas_;
    const PictureLayout& layout_;
    int left_;
    int top_;
};

template <std::size_t count>
void write_names(LegendWriter& legend, const std::array<std::string_view, count>& names,
                 const std::array<store::Rgb, count>& colours)
{
    for (std::size_t i = 0; i < count; ++i) {
        std::string name{i == 0 ? "right" : names[i]};
        std::replace(name.begin(), name.end(), '_', ' ');
        legend.write_swatch(colours[i], name);
    }
}

/// The font of a picture's panel, which is one of three, would be too large.
PictureLayout lay_out_heat_map(scene::ImageSize image)
{
    PictureLayout layout = lay_out_picture(image);
    layout.font = std::clamp(layout.panel.width_px / 56, 11, 18);
    layout.line = layout.font * 3 / 2;
    return layout;
}

std::string title_of(HeatMap kind)
{
    if (kind == HeatMap::cause) {
        return "Why pixels are wrong";
    }
    return kind == HeatMap::label ? "What the errors are called"
                                  : std::string{scale_of(kind).title};
}

} // namespace

std::optional<HeatMap> heat_map_from_name(std::string_view name)
{
    const auto* const found = std::find_if(kinds.begin(), kinds.end(),
                                           [&](const auto& kind) { return kind.first == name; });
    return found == kinds.end() ? std::nullopt : std::optional{found->second};
}

std::vector<std::string_view> heat_map_names()
{
    std::vector<std::string_view> names;
    for (const auto& [name, kind] : kinds) {
        names.push_back(name);
    }
    return names;
}

double share_on_scale(double value, double linear, double largest)
{
    const auto length = [&](double size) {
        return size <= linear ? size / linear : 1 + std::log10(size / linear);
    };
    const double share = std::min(length(std::abs(value)) / length(largest), 1.0);
    return 0.5 + 0.5 * std::copysign(share, value);
}

store::RgbImage draw_heat_map(const analysis::Comparison& comparison, HeatMap kind,
                              const std::filesystem::path& font_folder)
{
    const scene::Image<float> values = values_of(comparison, kind);
    const PictureLayout layout = lay_out_heat_map(values.size());
    const int image_top = layout.margin + 3 * layout.line;
    const int legend_top = image_top + layout.panel.height_px + layout.line;
    const scene::ImageSize size{layout.panel.width_px + 2 * layout.margin,
                                legend_top + 2 * layout.line + layout.margin};
    Canvas canvas{size, PictureColours::paper, font_folder};
    const Description words = describe(comparison);
    const auto write = [&](int line, const std::string& text, const TextStyle& style) {
        canvas.write(layout.margin, layout.margin + line * layout.line,
                     canvas.fitted(text, style, layout.panel.width_px), style);
    };
    const TextStyle faint{layout.font, false, PictureColours::faint_ink};
    write(1, title_of(kind), {layout.font * 5 / 4, true, PictureColours::ink});
    write(2,
          fmt::format("{}, {}, {}, {}", comparison.scene.name, words.map, words.lookup,
                      bias_in_brief(comparison)),
          faint);
    canvas.paste(coloured(values, kind, layout.panel), layout.margin, image_top);
    LegendWriter legend{canvas, layout, legend_top};
    if (kind == HeatMap::cause) {
        write_names(legend, analysis::cause_names, cause_colours);
    } else if (kind == HeatMap::label) {
        write_names(legend, analysis::label_names, label_colours);
    } else {
        legend.write_scale(scale_of(kind));
    }
    legend.write_swatch(no_value, "none");
    return canvas.image();
}

void write_heat_map(const std::filesystem::path& path, const analysis::Comparison& comparison,
                    HeatMap kind)
{
    store::write_file(path, store::encode_png(draw_heat_map(comparison, kind)));
}

} // namespace gnomon::reports
