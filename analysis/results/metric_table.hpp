#pragma once

#include "analysis/results/results.hpp"

#include <cstdint>
#include <functional>
#include <optional>
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

/// A metric's value; `std::monostate` where there is none.
using MetricValue = std::variant<std::monostate, std::uint64_t, double, bool>;

enum class MetricType : std::uint8_t {
    count,  ///< `std::uint64_t`
    number, ///< `double`
    flag,   ///< `bool`
};

/// What one number of a result is: everybody who writes, judges or describes it reads this.
struct MetricDescription {
    std::string
        name; ///< its path in `gnomon compare --json`, joined with dots; a column's name, too
    MetricType type = MetricType::number;
    std::string_view unit; ///< empty: a share, or none
    std::string meaning;   ///< with the denominator of a rate; Markdown
    std::optional<Worse> worse =
        {}; ///< for the gate, unless a rule says otherwise; empty: no rule may be about it
    std::string_view title = {}; ///< of the page's charts; empty: it is in none
    bool is_outcome = false;     ///< shown at first in the page's table of configurations
    /// Of its line in the table of `gnomon compare`; empty: it has none of its own. A line is shown
    /// where its value is not 0, or verdicts are fractions.
    std::string_view table_note = {};

    /// Whether a whole's value is the sum of its parts': of lights', for one.
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

/// Of the shadow map, as fitted.
[[nodiscard]] const CurveMetrics& map_metrics();
/// Of the pixels, with a configuration's own bias.
[[nodiscard]] const ConfigurationMetrics& configuration_metrics();
/// Of all constant biases at once.
[[nodiscard]] const CurveMetrics& curve_metrics();
/// All of them, in the order of the columns of results.csv.
[[nodiscard]] const std::vector<MetricDescription>& metric_descriptions();

} // namespace gnomon::analysis
