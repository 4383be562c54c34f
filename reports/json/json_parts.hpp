#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/results/metric_table.hpp"
#include "store/json.hpp"

#include <string>
#include <string_view>
#include <vector>

/// Parts of the JSON that `gnomon compare`, `evaluate` and `tune` print (docs/json_schema.md).
namespace gnomon::reports {

/// Finds or creates the member that a metric's name leads to. Parts between dots are members;
/// numbers, and the ends `lo` and `hi` of an interval, are array indices.
[[nodiscard]] store::Json& member_at(store::Json& json, std::string_view name);

/// Null for an empty value.
[[nodiscard]] store::Json value_json(const analysis::MetricValue& value);

/// Sets the member of each metric; null if it has no value.
template <typename Source>
void add_metrics(store::Json& json, const std::vector<analysis::Metric<Source>>& metrics,
                 const Source& source)
{
    for (const analysis::Metric<Source>& metric : metrics) {
        member_at(json, metric.name) = value_json(metric.value(source));
    }
}

/// Adds causes, labels, gaps, the bias curve and breakdowns. Without a diagnosis the fixed names
/// are null.
void add_diagnosis(store::Json& json, const analysis::Comparison& comparison);

/// Turns a comparison's JSON into that of another renderer's case: adds `evaluate`, causes found
/// from r and d, and `indeterminate_kinds.rounding`; sets values the case does not give to null.
/// @param evaluation  of that comparison.
void add_evaluation(store::Json& json, const analysis::Comparison& comparison,
                    const analysis::Evaluation& evaluation);

/// Adds `remedies`, `advice`, `views` and `views_passed_over`.
/// @param comparison  with a diagnosis.
void add_advice(store::Json& json, const analysis::Comparison& comparison);

/// The methods that a search passed over, and why.
[[nodiscard]] store::Json
methods_passed_over_json(const std::vector<analysis::PassedOverMethod>& passed_over);

/// A setting's errors in one view: counts, rates, amounts, softening, and the amount rate without
/// softening. Rates without a denominator are null.
[[nodiscard]] store::Json outcome_json(const analysis::ViewOutcome& outcome);

/// A view's name, eye, target, up and light.
[[nodiscard]] store::Json view_json(const std::string& name, const scene::CameraSettings& camera,
                                    const scene::LightSettings& light);

} // namespace gnomon::reports
