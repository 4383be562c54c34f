#include "reports/json/json_parts.hpp"

#include "analysis/advice/remedies.hpp"
#include "analysis/metrics/map_results.hpp"
#include "analysis/results/metric_table.hpp"
#include "methods/job_method.hpp"
#include "reports/text/findings.hpp"
#include "store/json_values.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

store::Json quantiles(const std::optional<analysis::Quantiles>& values)
{
    return values ? store::Json{{"count", values->count},
                                {"min", values->min},
                                {"median", values->median},
                                {"p95", values->p95},
                                {"max", values->max}}
                  : store::Json(nullptr);
}

/// JSON has no infinities: a missing limit is null.
store::Json finite_or_null(float value)
{
    return std::isfinite(value) ? store::Json(value) : store::Json(nullptr);
}

store::Json interval(const analysis::BiasInterval& interval)
{
    return store::Json::array({finite_or_null(interval.lo), finite_or_null(interval.hi)});
}

void add_limits(store::Json& json, const analysis::BiasLimits& limits)
{
    json["acne_free"] = finite_or_null(limits.acne_free);
    json["acne_free_count"] = finite_or_null(limits.acne_free_count);
    json["panning_free"] = finite_or_null(limits.panning_free);
    json["panning_free_beyond_zero"] = finite_or_null(limits.panning_free_beyond_zero);
}

void add_pareto_front(store::Json& bias_curve, const analysis::BiasCurve& curve)
{
    bias_curve["pareto_front"] = store::Json::array();
    for (const analysis::CurvePoint& point : analysis::pareto_front(curve, 33)) {
        bias_curve["pareto_front"].push_back({{"bias", finite_or_null(point.bias)},
                                              {"false_shadow", point.errors.false_shadow},
                                              {"false_lit", point.errors.false_lit}});
    }
}

/// The curve's metrics and points; null without a curve.
void add_bias_curve(store::Json& json, const analysis::Comparison& comparison)
{
    const analysis::Diagnosis& diagnosis = *comparison.diagnosis;
    if (!diagnosis.biases) {
        json["bias_curve"] = nullptr;
        return;
    }
    add_metrics(json, analysis::curve_metrics(), diagnosis.curve);
    add_pareto_front(json["bias_curve"], diagnosis.biases->curve);
    json["bias_curve"]["amount_ordinate"] =
        diagnosis.curve.amounts_are_sampled ? "sampled" : "exact";
    json["bias_curve"]["recommended"]["sentences"] = recommendation_sentences(comparison);
}

store::Json precision_kinds(const std::optional<analysis::PrecisionKinds>& kinds)
{
    return kinds ? store::Json{{"format", kinds->format}, {"transform", kinds->transform}}
                 : store::Json(nullptr);
}

store::Json slope_answers(const analysis::BiasAnswers& answers)
{
    store::Json json = store::Json::array();
    for (std::size_t i = 0; i < answers.slopes.size(); ++i) {
        const analysis::SlopeAnswer& answer = answers.slopes[i];
        store::Json entry{{"slope", answer.slope},
                          {"is_best", i == answers.best_slope},
                          {"best_interval", interval(answer.best.interval)},
                          {"best_errors", answer.best.errors.total()}};
        add_limits(entry, answer.bounds.strict);
        entry["no_constant_bias_serves"] = answer.bounds.no_constant_bias_serves;
        json.push_back(std::move(entry));
    }
    return json;
}

store::Json subset_json(const analysis::SubsetCounts& counts)
{
    store::Json json = store::Json::object();
    for (const analysis::SubsetQuantity& quantity : analysis::subset_quantities()) {
        json[std::string{quantity.name}] = value_json(quantity.value(counts));
    }
    for (const analysis::SubsetRate& rate : analysis::subset_rates()) {
        json[std::string{rate.name}] = store::number_or_null(rate_of(rate, counts));
    }
    return json;
}

store::Json bins(const std::vector<analysis::ErrorBin>& bins)
{
    store::Json json = store::Json::array();
    for (const analysis::ErrorBin& bin : bins) {
        store::Json entry{{"lower", bin.lower}, {"upper", bin.upper}};
        entry.update(subset_json(bin.counts));
        entry["needed_bias"] = quantiles(bin.needed_bias);
        entry["map_error_m"] = quantiles(bin.map_error_m);
        entry["envelope_m"] = store::number_or_null(bin.envelope_m);
        json.push_back(std::move(entry));
    }
    return json;
}

store::Json by_object(const std::vector<analysis::ObjectErrors>& objects)
{
    store::Json json = store::Json::array();
    for (const analysis::ObjectErrors& object : objects) {
        store::Json entry{{"object", object.name}};
        entry.update(subset_json(object.counts));
        json.push_back(std::move(entry));
    }
    return json;
}

/// Wrong pixels by name, without the first name, "none".
template <std::size_t size>
store::Json counts_by_name(const std::array<std::string_view, size>& names,
                           const std::array<std::uint64_t, size>& counts)
{
    store::Json json = store::Json::object();
    for (std::size_t i = 1; i < size; ++i) {
        json[std::string{names.at(i)}] = counts.at(i);
    }
    return json;
}

store::Json map_facts_json(const analysis::MapFacts& map)
{
    store::Json json{
        {"map", map.name}, {"near_m", map.near_m}, {"far_m", map.far_m}, {"texel_m", map.texel_m}};
    if (map.begin_m && map.end_m) {
        json["begin_m"] = *map.begin_m;
        json["end_m"] = *map.end_m;
    }
    if (map.bias) {
        json["bias"] = {{"constant", map.bias->constant},
                        {"constant_m", map.bias->constant_m},
                        {"constant_texels", map.bias->constant_texels},
                        {"slope_m", map.bias->slope_m},
                        {"normal_offset_m", map.bias->normal_offset_m}};
    }
    return json;
}

/// One entry per map.
store::Json by_map(const analysis::Comparison& comparison)
{
    const auto& of_maps = comparison.diagnosis->by_map;
    store::Json json = store::Json::array();
    for (std::size_t i = 0; i < of_maps.size(); ++i) {
        store::Json entry =
            map_facts_json(analysis::facts_of_map(comparison.job, comparison.view, i));
        entry.update(subset_json(of_maps[i].counts));
        const analysis::CauseCounts& causes = of_maps[i].causes;
        entry["causes"] = counts_by_name(analysis::cause_names, causes.by_cause);
        entry["labels"] = counts_by_name(analysis::label_names, causes.by_label);
        json.push_back(std::move(entry));
    }
    return json;
}

/// Results of GL's lookups at other biases; null if a formula gives the curve.
store::Json reruns(const analysis::CurveResult& curve)
{
    if (!curve.amounts_are_sampled) {
        return nullptr;
    }
    store::Json json = store::Json::array();
    for (const analysis::CurveSample& point : curve.points) {
        store::Json entry{{"bias", point.bias}};
        entry.update(subset_json(point.counts));
        json.push_back(std::move(entry));
    }
    return json;
}

store::Json verification(const std::optional<analysis::BiasVerification>& verification)
{
    if (!verification) {
        return nullptr;
    }
    store::Json reruns = store::Json::array();
    for (const analysis::BiasVerification::Rerun& rerun : verification->reruns) {
        reruns.push_back({{"bias", rerun.bias},
                          {"lit", rerun.lit},
                          {"shadowed", rerun.shadowed},
                          {"differences", rerun.differences}});
    }
    return {{"biases", verification->reruns.size()},
            {"verdicts", verification->verdicts()},
            {"differences", verification->differences()},
            {"reruns", std::move(reruns)}};
}

void add_no_diagnosis(store::Json& json, const analysis::Comparison& comparison)
{
    constexpr std::array<std::string_view, 21> names{"causes",
                                                     "labels",
                                                     "cause_amounts",
                                                     "label_amounts",
                                                     "error_amount",
                                                     "cause_arithmetic",
                                                     "precision_kinds",
                                                     "bias_curve",
                                                     "bias_source",
                                                     "bias_reruns",
                                                     "verification",
                                                     "slope_curves",
                                                     "by_light_distance_m",
                                                     "by_receiver_angle_rad",
                                                     "by_object",
                                                     "findings",
                                                     "advice",
                                                     "remedies",
                                                     "views",
                                                     "views_passed_over",
                                                     "cures"};
    for (const std::string_view name : names) {
        json[std::string{name}] = nullptr;
    }
    if (comparison.evaluation) {
        json["by_object"] = by_object(comparison.evaluation->by_object);
    }
}

} // namespace

void add_diagnosis(store::Json& json, const analysis::Comparison& comparison)
{
    const auto& diagnosis = comparison.diagnosis;
    if (!diagnosis) {
        add_no_diagnosis(json, comparison);
        return;
    }
    json["error_amount"] = analysis::error_amount(comparison);
    json["cause_arithmetic"] =
        methods::traits(comparison.job).has_exact_causes() ? "exact" : "float32";
    json["precision_kinds"] = precision_kinds(comparison.precision_kinds);
    add_bias_curve(json, comparison);
    if (methods::traits(comparison.job).has_map) {
        json["bias_source"] = diagnosis->biases ? "curve" : "rerun";
    } else {
        json["bias_source"] = nullptr; // the lookup has no bias
    }
    json["bias_reruns"] = reruns(diagnosis->curve);
    json["verification"] = verification(comparison.verification);
    json["slope_curves"] =
        diagnosis->biases ? slope_answers(*diagnosis->biases) : store::Json(nullptr);
    json["by_light_distance_m"] = bins(diagnosis->by_distance);
    json["by_receiver_angle_rad"] = bins(diagnosis->by_angle);
    json["by_object"] = by_object(diagnosis->by_object);
    if (!diagnosis->by_map.empty()) {
        json["by_map"] = by_map(comparison);
    }
    json["findings"] = findings(comparison);
    add_advice(json, comparison);
}

} // namespace gnomon::reports
