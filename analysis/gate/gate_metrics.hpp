#pragma once

#include "analysis/results/metric_table.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// A number that a rule may judge (docs/gate.md).
struct GateMetric {
    std::string_view name;
    bool is_pixel_count = false; ///< a count of pixels, or an amount of them
    Worse worse = Worse::up;     ///< unless a rule overrides it
    bool is_whole = false;       ///< its values are integers
};

/// Metrics with a worse side from the metric table, in its order: columns of results.csv.
[[nodiscard]] const std::vector<GateMetric>& result_metrics();
/// All metrics with names of their own: those columns, and values derived from them and from other
/// tables.
[[nodiscard]] const std::vector<GateMetric>& gate_metrics();

/// The metric of that name; for a point of the bias curve, its column.
/// @return  nullptr if no metric has that name.
[[nodiscard]] const GateMetric* find_gate_metric(std::string_view name);
/// Whether a metric's values are integers; false for an unknown name.
[[nodiscard]] bool is_whole_metric(std::string_view name);

/// False shadow and false lit.
inline constexpr std::string_view wrong_pixels_metric = "wrong_pixels";
/// Both amounts of error.
inline constexpr std::string_view error_amount_metric = "error_amount";
/// Whether a metric is an amount of error, or a rate of one.
[[nodiscard]] bool is_amount(std::string_view metric);
/// Lit and blocked pixels.
inline constexpr std::string_view scored_pixels_metric = "scored_pixels";
/// Pixels that are wrong now and were right in the baseline.
inline constexpr std::string_view new_pixels_metric = "new_pixels";

/// A count or rate at one bias of the bias curve: "bias_curve.at(0.001).false_lit".
struct CurvePointMetric {
    double bias = 0;    ///< depth units
    std::string column; ///< of bias_curves.csv

    [[nodiscard]] std::string name() const;
};
/// The columns that such a metric can name.
[[nodiscard]] const std::vector<std::string>& curve_point_columns();
/// Parses the name of such a metric; empty if the text is not one.
[[nodiscard]] std::optional<CurvePointMetric> curve_point_metric(std::string_view text);

/// How many pixels have a peter-panning gap.
inline constexpr std::string_view gap_pixels_metric = "peter_panning_gap_pixels";

/// Whether a metric is a peter-panning gap's length, in metres or texels.
[[nodiscard]] bool is_gap_length(std::string_view name);

/// The whole text as a finite number; empty if it is not one.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

} // namespace gnomon::analysis
