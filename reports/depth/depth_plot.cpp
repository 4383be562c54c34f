#include "reports/depth/depth_report.hpp"

#include "analysis/depth/depth_error.hpp"
#include "reports/depth/depth_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::reports {

namespace {

using analysis::DepthErrorRow;
using analysis::DepthMapping;
using analysis::DepthStudy;

// Okabe and Ito's colours, distinct for any colour vision.
constexpr store::Rgb sawtooth_colour{150, 200, 235};
constexpr store::Rgb measured_colour{0, 90, 150};
constexpr store::Rgb envelope_colour{213, 94, 0};
constexpr store::Rgb tolerance_colour{0, 158, 115};
constexpr store::Rgb grid_colour{226, 226, 226};
constexpr store::Rgb frame_colour{90, 90, 90};

constexpr double left_px = 110;
constexpr double right_px = 1250;
constexpr double top_px = 112;
constexpr double bottom_px = 722;
constexpr double tolerance_key_px = 220;
constexpr std::size_t most_drawn_rows = 3000;
constexpr int points_per_px = 6; // enough to follow a tooth that is a pixel wide

/// An axis, linear or logarithmic.
class Axis {
public:
    Axis(double low, double high, double low_px, double high_px, bool is_log)
        : low_{low},
          high_{high},
          low_px_{low_px},
          high_px_{high_px},
          is_log_{is_log}
    {
    }

    [[nodiscard]] double px(double value) const
    {
        const double share = is_log_ ? std::log(value / low_) / std::log(high_ / low_)
                                     : (value - low_) / (high_ - low_);
        return low_px_ + share * (high_px_ - low_px_);
    }
    [[nodiscard]] double value(double at_px) const
    {
        const double share = (at_px - low_px_) / (high_px_ - low_px_);
        return is_log_ ? low_ * std::pow(high_ / low_, share) : low_ + share * (high_ - low_);
    }
    /// Ticks at powers of ten, or at five to ten round steps.
    [[nodiscard]] std::vector<double> ticks() const
    {
        std::vector<double> result;
        if (is_log_) {
            for (double tick = std::pow(10, std::ceil(std::log10(low_) - 1e-9));
                 tick <= high_ * (1 + 1e-9); tick *= 10) {
                result.push_back(tick);
            }
            return result;
        }
        const double power = std::pow(10, std::floor(std::log10((high_ - low_) / 5)));
        const double step = (high_ - low_) / power > 25   ? 5 * power
                            : (high_ - low_) / power > 10 ? 2 * power
                                                          : power;
        for (double tick = std::ceil(low_ / step) * step; tick <= high_ + 1e-9 * step;
             tick += step) {
            result.push_back(std::abs(tick) < 1e-9 * step ? 0 : tick);
        }
        return result;
    }
    [[nodiscard]] double clamped_px(double magnitude) const
    {
        return px(std::clamp(magnitude, low_, high_));
    }

private:
    double low_;
    double high_;
    double low_px_;
    double high_px_;
    bool is_log_;
};

struct Axes {
    Axis x;
    Axis y;
};

Axes make_axes(const DepthStudy& study, std::span<const DepthErrorRow> rows)
{
    const DepthMapping& mapping = study.mapping;
    double largest_m = study.theory.max_error_m;
    for (const DepthErrorRow& row : rows) {
        largest_m = std::max(largest_m, std::abs(row.error_m));
    }
    if (study.tolerance) {
        largest_m = std::max(largest_m, study.tolerance->tolerance_m);
    }
    // Two decades below the envelope's smallest end: teeth go down to 0 and must be cut somewhere.
    const double smallest_m =
        std::min(study.theory.envelope_at_near_m, study.theory.envelope_at_far_m);
    double low_m = std::max(smallest_m / 50, largest_m * 1e-6);
    if (study.tolerance) {
        low_m = std::min(low_m, 0.5 * study.tolerance->tolerance_m);
    }
    const bool is_log = mapping.near_m() > 0 && mapping.far_m() > 100 * mapping.near_m();
    return {Axis{mapping.near_m(), mapping.far_m(), left_px, right_px, is_log},
            Axis{std::pow(10, std::floor(std::log10(low_m))), 1.8 * largest_m, bottom_px, top_px,
                 true}};
}

void add_frame(Drawing& drawing, const DepthMapping& mapping, const Axes& axes)
{
    for (const double tick : axes.x.ticks()) {
        const double x = axes.x.px(tick);
        drawing.marks.emplace_back(Polyline{{{x, top_px}, {x, bottom_px}}, grid_colour, 1});
        drawing.labels.push_back(
            {{x, bottom_px + 24}, fmt::format("{:g}", tick), {16}, Anchor::middle});
    }
    for (const double tick : axes.y.ticks()) {
        const double y = axes.y.px(tick);
        drawing.marks.emplace_back(Polyline{{{left_px, y}, {right_px, y}}, grid_colour, 1});
        drawing.labels.push_back({{left_px - 10, y + 6},
                                  fmt::format("1e{}", std::lround(std::log10(tick))),
                                  {16},
                                  Anchor::end});
    }
    const bool has_depths = mapping.stores_gl_depth();
    drawing.labels.push_back({{0.5 * (left_px + right_px), bottom_px + 54},
                              fmt::format("distance {} from the {} [m]", distance_symbol(mapping),
                                          has_depths ? "camera's plane" : "light"),
                              {17},
                              Anchor::middle});
    drawing.labels.push_back({{left_px - 62, top_px - 14},
                              fmt::format("|error of {}| [m]", distance_symbol(mapping)),
                              {17}});
}

void add_border(Drawing& drawing)
{
    drawing.marks.emplace_back(Polyline{{{left_px, top_px},
                                         {right_px, top_px},
                                         {right_px, bottom_px},
                                         {left_px, bottom_px},
                                         {left_px, top_px}},
                                        frame_colour,
                                        1});
}

/// Draws the formula curves, sampled along the axis.
void add_formulas(Drawing& drawing, const DepthStudy& study, const Axes& axes)
{
    Polyline sawtooth{{}, sawtooth_colour, 1};
    Polyline envelope{{}, envelope_colour, 2.4};
    const int count = static_cast<int>(right_px - left_px) * points_per_px;
    for (int i = 0; i <= count; ++i) {
        const double x = left_px + (right_px - left_px) * i / count;
        const double light_distance_m =
            std::clamp(axes.x.value(x), study.mapping.near_m(), study.mapping.far_m());
        const auto stored = analysis::stored_depth(study.mapping, study.coding, light_distance_m);
        sawtooth.points.push_back({x, axes.y.clamped_px(std::abs(stored.error_m))});
        if (i % points_per_px == 0) {
            envelope.points.push_back({x, axes.y.clamped_px(analysis::error_envelope_m(
                                              study.mapping, study.coding, light_distance_m))});
        }
    }
    drawing.marks.emplace_back(std::move(sawtooth));
    drawing.marks.emplace_back(std::move(envelope));
}

void add_measured(Drawing& drawing, std::span<const DepthErrorRow> rows, const Axes& axes)
{
    Dots dots{{}, measured_colour, 1.6};
    const std::size_t stride = std::max<std::size_t>(1, rows.size() / most_drawn_rows);
    for (std::size_t i = 0; i < rows.size(); i += stride) {
        dots.centres.push_back(
            {axes.x.px(rows[i].light_distance_m), axes.y.clamped_px(std::abs(rows[i].error_m))});
    }
    // Draw below the envelope's line, above the sawtooth.
    drawing.marks.insert(drawing.marks.end() - 1, std::move(dots));
}

/// Draws the tolerance, and the distance from which the envelope exceeds it.
void add_tolerance(Drawing& drawing, const analysis::ConstantTolerance& tolerance, const Axes& axes)
{
    const double y = axes.y.px(tolerance.tolerance_m);
    drawing.marks.emplace_back(Polyline{{{left_px, y}, {right_px, y}}, tolerance_colour, 2.4});
    if (tolerance.exceeded_from_m) {
        const double x = axes.x.px(*tolerance.exceeded_from_m);
        drawing.marks.emplace_back(Polyline{{{x, y}, {x, bottom_px}}, tolerance_colour, 1.2});
    }
}

void add_titles(Drawing& drawing, const DepthStudy& study, const std::string& gl_renderer)
{
    drawing.labels.push_back(
        {{left_px - 62, 38},
         fmt::format("{} error of {}: {}", study.mapping.stores_gl_depth() ? "Depth" : "Distance",
                     study.format, mapping_text(study.mapping)),
         {21, true}});
    double x = right_px - 700 - (study.tolerance ? tolerance_key_px : 0);
    const auto key = [&](store::Rgb colour, double width_px, const std::string& text,
                         double advance_px) {
        drawing.marks.emplace_back(
            Polyline{{{x, top_px - 20}, {x + 28, top_px - 20}}, colour, width_px});
        drawing.labels.push_back({{x + 36, top_px - 14}, text, {16}});
        x += advance_px;
    };
    key(envelope_colour, 2.4, "formula's envelope", 220);
    key(sawtooth_colour, 3, "formula's sawtooth", 222);
    if (study.tolerance) {
        key(tolerance_colour, 2.4,
            fmt::format("tolerance {}", metres(study.tolerance->tolerance_m)), tolerance_key_px);
    }
    if (study.measured) {
        drawing.marks.emplace_back(
            Dots{{{x + 6, top_px - 20}, {x + 14, top_px - 20}, {x + 22, top_px - 20}},
                 measured_colour,
                 2.2});
        drawing.labels.push_back({{x + 36, top_px - 14}, "stored by GL, measured", {16}});
        drawing.labels.push_back({{left_px - 62, 66}, gl_renderer, {15}});
    }
}

} // namespace

Drawing depth_plot(const DepthStudy& study, std::span<const DepthErrorRow> rows,
                   const std::string& gl_renderer)
{
    const std::span<const DepthErrorRow> measured =
        study.measured ? rows : std::span<const DepthErrorRow>{};
    const Axes axes = make_axes(study, measured);
    Drawing drawing;
    add_frame(drawing, study.mapping, axes);
    add_formulas(drawing, study, axes);
    if (study.measured) {
        add_measured(drawing, measured, axes);
    }
    if (study.tolerance) {
        add_tolerance(drawing, *study.tolerance, axes);
    }
    add_border(drawing);
    add_titles(drawing, study, gl_renderer);
    return drawing;
}

} // namespace gnomon::reports
