#pragma once

#include "reports/pictures/canvas.hpp"
#include "store/images/png.hpp"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace gnomon::reports {

/// A point of a drawing [px], from its top left.
struct Point {
    double x = 0;
    double y = 0;
};

/// Straight lines from point to point.
struct Polyline {
    std::vector<Point> points;
    store::Rgb colour;
    double width_px = 1;
};
/// Filled circles.
struct Dots {
    std::vector<Point> centres;
    store::Rgb colour;
    double radius_px = 1;
};
enum class Anchor : std::uint8_t { start, middle, end };
/// One line of text on its baseline.
struct Label {
    Point at;
    std::string text;
    TextStyle style;
    Anchor anchor = Anchor::start;
};

/// A figure of lines, dots and texts on white. Later marks cover earlier ones; labels are on top.
struct Drawing {
    scene::ImageSize size{1280, 800};
    std::vector<std::variant<Polyline, Dots>> marks;
    std::vector<Label> labels;
};

/// The drawing as SVG 1.1.
[[nodiscard]] std::string svg_text(const Drawing& drawing);

/// The drawing as pixels, antialiased.
/// @throws scene::EnvironmentError  naming the package, if the font is missing.
[[nodiscard]] store::RgbImage
rasterise(const Drawing& drawing, const std::filesystem::path& font_folder = default_font_folder);

/// Writes SVG or PNG, by the path's extension.
/// @throws scene::InputError        as `require_output_name` does.
/// @throws scene::EnvironmentError  if it cannot be drawn or written.
void write_drawing(const std::filesystem::path& path, const Drawing& drawing);

} // namespace gnomon::reports
