#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// Which change of a metric is for the worse.
enum class Worse : std::uint8_t {
    up,
    down,
    both, ///< either
};

/// A column of results.csv that was measured and is a number (docs/csv_schema.md).
struct GateMetric {
    std::string_view name;
    bool is_pixel_count = false;
    Worse worse = Worse::up; ///< unless a rule says otherwise
};

/// All of them, in the order of results.csv.
[[nodiscard]] const std::vector<GateMetric>& gate_metrics();

/// @return  nullptr if there is none of that name.
[[nodiscard]] const GateMetric* find_gate_metric(std::string_view name);

/// How many pixels have a peter-panning gap.
inline constexpr std::string_view gap_pixels_metric = "peter_panning_gap_pixels";

/// Whether a metric is a peter-panning gap's length, in metres or texels.
[[nodiscard]] bool is_gap_length(std::string_view name);

/// The whole text as a finite number.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

} // namespace gnomon::analysis
