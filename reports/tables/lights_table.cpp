#include "reports/tables/lights_table.hpp"

#include "analysis/comparison/finished_curve.hpp"
#include "analysis/results/totals.hpp"
#include "reports/tables/comparison_table.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/text/text.hpp"

#include <algorithm>

namespace gnomon::reports {

namespace {

constexpr std::size_t light_columns = 24;
constexpr std::size_t number_columns = 14;
constexpr std::size_t share_columns = 12;

std::string line(std::string_view name, std::string_view scored, std::string_view shadow,
                 std::string_view light, std::string_view rate)
{
    return pad_right(name, light_columns) + pad_left(scored, number_columns) +
           pad_left(shadow, number_columns) + pad_left(light, number_columns) +
           pad_left(rate, share_columns) + "\n";
}

std::string error_line(const std::string& name, const analysis::Metrics& metrics)
{
    return line(name, grouped(metrics.pixels.scored()), grouped(metrics.false_shadow),
                grouped(metrics.false_lit), percent(metrics.error_rate));
}

std::string amount_line(const std::string& name, const analysis::Metrics& metrics)
{
    return line(name, "", grouped_amount(metrics.amounts.shadow),
                grouped_amount(metrics.amounts.light), percent(metrics.mean_abs_error));
}

/// A line of each light and of all together.
template <typename Line>
std::string lines(std::span<const analysis::Comparison> lights, const analysis::Metrics& total,
                  Line&& line_of)
{
    std::string text;
    for (const analysis::Comparison& comparison : lights) {
        text += line_of(comparison.light, comparison.metrics);
    }
    return text + line_of("all lights", total);
}

} // namespace

std::string lights_table(std::span<const analysis::Comparison> lights)
{
    std::string text;
    for (const analysis::Comparison& comparison : lights) {
        text += heading_line("light " + comparison.light) + comparison_table(comparison) + "\n";
    }
    const analysis::Metrics total = analysis::total_of(analysis::results_of(lights)).metrics;
    text += heading_line("totals");
    text += line("light", "scored", "false shadow", "false lit", "rate");
    text += lines(lights, total, error_line);
    const auto has_fractions = [](const analysis::Comparison& comparison) {
        return analysis::has_fractions(comparison.metrics);
    };
    if (std::ranges::any_of(lights, has_fractions)) {
        text += line("amount [px]", "", "false shadow", "false light", "mean");
        text += lines(lights, total, amount_line);
    }
    return text;
}

} // namespace gnomon::reports
