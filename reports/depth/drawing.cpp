#include "reports/depth/drawing.hpp"

#include "scene/error.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

namespace gnomon::reports {

namespace {

constexpr store::Rgb white{255, 255, 255};

std::string css_colour(store::Rgb colour)
{
    return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

std::string svg_escaped(std::string_view text)
{
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '<':
            result += "&lt;";
            break;
        case '&':
            result += "&amp;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

void append_svg(std::string& svg, const Polyline& line)
{
    auto out = std::back_inserter(svg);
    fmt::format_to(out, "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" points=\"",
                   css_colour(line.colour), line.width_px);
    for (const Point& point : line.points) {
        fmt::format_to(out, "{:.2f},{:.2f} ", point.x, point.y);
    }
    svg += "\"/>\n";
}

void append_svg(std::string& svg, const Dots& dots)
{
    auto out = std::back_inserter(svg);
    fmt::format_to(out, "<g fill=\"{}\">\n", css_colour(dots.colour));
    for (const Point& centre : dots.centres) {
        fmt::format_to(out, "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\"/>\n", centre.x, centre.y,
                       dots.radius_px);
    }
    svg += "</g>\n";
}

void append_svg(std::string& svg, const Label& label)
{
    constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
    fmt::format_to(std::back_inserter(svg),
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\"{} fill=\"{}\" "
                   "text-anchor=\"{}\">{}</text>\n",
                   label.at.x, label.at.y, label.style.size_px,
                   label.style.bold ? " font-weight=\"bold\"" : "", css_colour(label.style.colour),
                   anchors.at(static_cast<std::size_t>(label.anchor)), svg_escaped(label.text));
}

void blend(store::Rgb& pixel, store::Rgb colour, double coverage)
{
    const auto mix = [&](std::uint8_t below, std::uint8_t above) {
        return static_cast<std::uint8_t>(std::lround(below + coverage * (above - below)));
    };
    pixel = {mix(pixel.r, colour.r), mix(pixel.g, colour.g), mix(pixel.b, colour.b)};
}

double distance_px(Point p, Point a, Point b)
{
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double length2 = dx * dx + dy * dy;
    const double along =
        length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0;
    return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

/// Paints pixels within `radius_px` of the line from a to b; coverage is one half at the radius.
void paint(store::RgbImage& image, Point a, Point b, double radius_px, store::Rgb colour)
{
    const auto [width_px, height_px] = image.size();
    const auto first = [&](double from) {
        return std::max(0, static_cast<int>(std::floor(from - radius_px - 1)));
    };
    const auto last = [&](double to, int end) {
        return std::min(end - 1, static_cast<int>(std::ceil(to + radius_px + 1)));
    };
    for (int y = first(std::min(a.y, b.y)); y <= last(std::max(a.y, b.y), height_px); ++y) {
        for (int x = first(std::min(a.x, b.x)); x <= last(std::max(a.x, b.x), width_px); ++x) {
            const double distance = distance_px({x + 0.5, y + 0.5}, a, b);
            const double coverage = std::min(1.0, radius_px + 0.5 - distance);
            if (coverage > 0) {
                blend(image(x, y), colour, coverage * std::min(1.0, 2 * radius_px));
            }
        }
    }
}

void paint(store::RgbImage& image, const Polyline& line)
{
    for (std::size_t i = 1; i < line.points.size(); ++i) {
        paint(image, line.points[i - 1], line.points[i], 0.5 * line.width_px, line.colour);
    }
}

void paint(store::RgbImage& image, const Dots& dots)
{
    for (const Point& centre : dots.centres) {
        paint(image, centre, centre, dots.radius_px, dots.colour);
    }
}

void write_label(Canvas& canvas, const Label& label)
{
    const int width_px = canvas.text_width_px(label.text, label.style);
    const int before_px = label.anchor == Anchor::start    ? 0
                          : label.anchor == Anchor::middle ? width_px / 2
                                                           : width_px;
    canvas.write(static_cast<int>(std::lround(label.at.x)) - before_px,
                 static_cast<int>(std::lround(label.at.y)), label.text, label.style);
}

} // namespace

std::string svg_text(const Drawing& drawing)
{
    const auto [width_px, height_px] = drawing.size;
    std::string svg =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                    "viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, sans-serif\">\n"
                    "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
                    width_px, height_px);
    for (const auto& mark : drawing.marks) {
        std::visit([&](const auto& shape) { append_svg(svg, shape); }, mark);
    }
    for (const Label& label : drawing.labels) {
        append_svg(svg, label);
    }
    return svg + "</svg>\n";
}

store::RgbImage rasterise(const Drawing& drawing, const std::filesystem::path& font_folder)
{
    store::RgbImage image{drawing.size, white};
    for (const auto& mark : drawing.marks) {
        std::visit([&](const auto& shape) { paint(image, shape); }, mark);
    }
    Canvas canvas{drawing.size, white, font_folder};
    canvas.paste(image, 0, 0);
    for (const Label& label : drawing.labels) {
        write_label(canvas, label);
    }
    return canvas.image();
}

void write_drawing(const std::filesystem::path& path, const Drawing& drawing)
{
    store::require_output_name(path, store::OutputKind::plot);
    if (path.extension() == ".svg") {
        store::write_file(path, svg_text(drawing));
    } else {
        store::write_file(path, store::encode_png(rasterise(drawing)));
    }
}

} // namespace gnomon::reports
