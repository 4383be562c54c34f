#pragma once

#include "analysis/metrics/breakdown.hpp"
#include "analysis/results/results.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::analysis {

/// Which change of a metric is for the worse.
enum class Worse : std::uint8_t {
    up,
    down,
    both, ///< either
};

/// A metric's value; `std::monostate` if it has none.
using MetricValue = std::variant<std::monostate, std::uint64_t, double, bool>;

enum class MetricType : std::uint8_t {
    count,  ///< `std::uint64_t`
    number, ///< `double`
    flag,   ///< `bool`
};

/// Describes one number of a result, for all who write, judge or document it.
struct MetricDescription {
    std::string name; ///< path in `gnomon compare --json`, joined with dots; also a column's name
    MetricType type = MetricType::number;
    std::string_view unit; ///< empty for a share, or a number without a unit
    std::string meaning;   ///< with the denominator of a rate; Markdown
    /// For the gate, unless a rule overrides it; empty: no rule may judge it.
    std::optional<Worse> worse = {};
    std::string_view title = {}; ///< in the page's charts; empty: in none
    bool is_outcome = false;     ///< shown initially in the page's table of configurations
    /// Note on its line in the table of `gnomon compare`; empty: it has no line. A line is shown if
    /// its value is not 0 or verdicts are fractions.
    std::string_view table_note = {};

    /// Whether the values of parts, such as lights, add up to that of the whole.
    [[nodiscard]] bool adds_up() const { return type == MetricType::count || unit == "px"; }
};

template <typename Source>
struct Metric : MetricDescription {
    std::function<MetricValue(const Source&)> value;
};

using CurveMetrics = std::vector<Metric<CurveResult>>;
using ConfigurationMetrics = std::vector<Metric<ConfigurationResult>>;

/// Build the lists that `map_metrics` and the functions below it keep.
[[nodiscard]] CurveMetrics describe_map_metrics();
[[nodiscard]] ConfigurationMetrics describe_configuration_metrics();
[[nodiscard]] CurveMetrics describe_curve_metrics();

/// Metrics of the shadow map, as fitted.
[[nodiscard]] const CurveMetrics& map_metrics();
/// Metrics of the pixels, with a configuration's own bias.
[[nodiscard]] const ConfigurationMetrics& configuration_metrics();
/// Metrics of all constant biases at once.
[[nodiscard]] const CurveMetrics& curve_metrics();
/// All metrics, in the order of the columns of results.csv.
[[nodiscard]] const std::vector<MetricDescription>& metric_descriptions();

/// A number that is counted or summed in every subset of the scored pixels: in bins, objects,
/// cells, points of the bias curve, and the whole image.
struct SubsetQuantity {
    std::string_view name;
    MetricType type; ///< `count` or `number`
    MetricValue (*value)(const SubsetCounts&);

    [[nodiscard]] double number(const SubsetCounts& subset) const;
};

/// `lit` and `blocked`, then their errors.
[[nodiscard]] std::span<const SubsetQuantity> subset_quantities();
/// The errors alone: those after `lit` and `blocked`.
[[nodiscard]] std::span<const SubsetQuantity> subset_errors();

/// A quotient of quantities: both sides are sums.
struct SubsetRate {
    std::string_view name;
    std::span<const std::string_view> errors; ///< names of `subset_quantities`
    std::span<const std::string_view> pixels; ///< names of them, mostly `lit`, `blocked`, or both
    std::string_view meaning;                 ///< from here on as in `MetricDescription`
    std::string_view title;
    bool is_outcome = false;
    std::string_view table_note = {};
};

/// All rates, and `mean_abs_error`; each is also a metric of a configuration.
[[nodiscard]] std::span<const SubsetRate> subset_rates();
/// The rate in one subset; empty if it has no such pixels.
[[nodiscard]] std::optional<double> rate_of(const SubsetRate& rate, const SubsetCounts& counts);

} // namespace gnomon::analysis
