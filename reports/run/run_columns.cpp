#include "reports/run/run_columns.hpp"

#include "reports/run/error_parts_json.hpp"
#include "scene/job_keys.hpp"
#include "scene/job_toml.hpp"
#include "scene/sweep_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace gnomon::reports {

namespace {

using analysis::BiasBounds;
using analysis::BiasLimits;
using analysis::ConfigurationResult;
using analysis::CurveResult;
using analysis::ErrorBin;
using analysis::Quantiles;
using sqlite::Value;

constexpr std::string_view integer_type = "INTEGER";
constexpr std::string_view real_type = "REAL";
constexpr std::string_view text_type = "TEXT";

using ResultColumns = std::vector<RunColumn<ConfigurationResult>>;
using CurveColumns = std::vector<RunColumn<CurveResult>>;

Value count(std::uint64_t value)
{
    return static_cast<std::int64_t>(value);
}
Value number(const std::optional<double>& value)
{
    return value ? Value{*value} : Value{};
}
/// As in JSON: a limit that does not exist is NULL.
Value finite(float value)
{
    return std::isfinite(value) ? Value{double{value}} : Value{};
}
Value flag(bool value)
{
    return std::string{value ? "true" : "false"};
}

std::string_view type_of(const scene::Domain& domain)
{
    if (std::holds_alternative<scene::IntegerDomain>(domain)) {
        return integer_type;
    }
    return std::holds_alternative<scene::RealDomain>(domain) ? real_type : text_type;
}

void add_class_columns(ResultColumns& columns)
{
    columns.push_back({"pixels.total", integer_type, [](const ConfigurationResult& result) {
                           return count(result.metrics.pixels.total);
                       }});
    for (std::size_t i = 0; i < scene::pixel_class_count; ++i) {
        columns.push_back({fmt::format("pixels.{}", scene::pixel_class_names[i]), integer_type,
                           [i](const ConfigurationResult& result) {
                               return count(result.metrics.pixels.by_class[i]);
                           }});
    }
}

void add_reason_columns(ResultColumns& columns)
{
    using scene::ClassReason;
    const std::vector<std::pair<const char*, ClassReason>> reasons{
        {"unmatched_kinds.snap", ClassReason::snap},
        {"unmatched_kinds.tie", ClassReason::tie},
        {"unmatched_kinds.mismatch", ClassReason::mismatch},
        {"indeterminate_kinds.silhouette", ClassReason::silhouette},
        {"indeterminate_kinds.vertex", ClassReason::vertex},
        {"indeterminate_kinds.graze", ClassReason::graze}};
    for (const auto& [name, reason] : reasons) {
        columns.push_back(
            {name, integer_type, [reason = reason](const ConfigurationResult& result) {
                 return count(result.metrics.pixels.of(reason));
             }});
    }
}

void add_error_columns(ResultColumns& columns)
{
    using analysis::Metrics;
    for (const auto& [name, member] :
         {std::pair{"false_shadow", &Metrics::false_shadow}, {"false_lit", &Metrics::false_lit}}) {
        columns.push_back(
            {name, integer_type, [member = member](const ConfigurationResult& result) {
                 return count(result.metrics.*member);
             }});
    }
    for (const auto& [name, member] : {std::pair{"false_shadow_rate", &Metrics::false_shadow_rate},
                                       {"false_lit_rate", &Metrics::false_lit_rate},
                                       {"error_rate", &Metrics::error_rate},
                                       {"mean_abs_error", &Metrics::mean_abs_error}}) {
        columns.push_back({name, real_type, [member = member](const ConfigurationResult& result) {
                               return number(result.metrics.*member);
                           }});
    }
}

/// The first name, "none", is left out.
template <typename Names, typename Counts>
void add_counts_by_name(ResultColumns& columns, std::string_view group, const Names& names,
                        Counts analysis::CauseCounts::*counts)
{
    for (std::size_t i = 1; i < names.size(); ++i) {
        columns.push_back({fmt::format("{}.{}", group, names[i]), integer_type,
                           [i, counts](const ConfigurationResult& result) {
                               return result.causes ? count(((*result.causes).*counts)[i])
                                                    : Value{};
                           }});
    }
}

void add_gap_columns(ResultColumns& columns)
{
    using analysis::Gaps;
    for (const auto& [group, unit] : {std::pair{"peter_panning_gap_m", &Gaps::metres},
                                      {"peter_panning_gap_texels", &Gaps::texels}}) {
        for (const auto& [name, member] : {std::pair{"median", &Quantiles::median},
                                           {"p95", &Quantiles::p95},
                                           {"max", &Quantiles::max}}) {
            columns.push_back({fmt::format("{}.{}", group, name), real_type,
                               [unit = unit, member = member](const ConfigurationResult& result) {
                                   const auto& lengths = result.peter_panning.*unit;
                                   return lengths ? finite((*lengths).*member) : Value{};
                               }});
        }
    }
    columns.push_back(
        {"peter_panning_gap_pixels", integer_type, [](const ConfigurationResult& result) {
             const auto& gaps = result.peter_panning.metres;
             return result.causes ? count(gaps ? gaps->count : 0) : Value{};
         }});
}

/// Finds the limits that three columns are about.
using FindLimits = std::function<const BiasLimits&(const BiasBounds&)>;

void add_limit_columns(CurveColumns& columns, const std::string& prefix, const FindLimits& find)
{
    for (const auto& [name, member] :
         {std::pair{"acne_free", &BiasLimits::acne_free},
          {"panning_free", &BiasLimits::panning_free},
          {"panning_free_beyond_zero", &BiasLimits::panning_free_beyond_zero}}) {
        columns.push_back(
            {prefix + name, real_type, [find, member = member](const CurveResult& curve) {
                 return curve.bounds ? finite(find(*curve.bounds).*member) : Value{};
             }});
    }
}

void add_allowance_columns(CurveColumns& columns)
{
    for (std::size_t i = 0; i < std::tuple_size_v<decltype(BiasBounds::allowances)>; ++i) {
        const std::string prefix = fmt::format("bias_curve.allowances.{}.", i);
        columns.push_back({prefix + "allowance", real_type, [i](const CurveResult& curve) {
                               return curve.bounds ? Value{curve.bounds->allowances[i].allowance}
                                                   : Value{};
                           }});
        add_limit_columns(columns, prefix, [i](const BiasBounds& bounds) -> const BiasLimits& {
            return bounds.allowances[i];
        });
    }
}

void add_best_columns(CurveColumns& columns)
{
    using analysis::BiasInterval;
    for (const auto& [name, end] :
         {std::pair{"lo", &BiasInterval::lo}, {"hi", &BiasInterval::hi}}) {
        columns.push_back({fmt::format("bias_curve.best_interval.{}", name), real_type,
                           [end = end](const CurveResult& curve) {
                               return curve.best ? finite(curve.best->interval.*end) : Value{};
                           }});
    }
    columns.push_back({"bias_curve.best_errors", integer_type, [](const CurveResult& curve) {
                           return curve.best ? count(curve.best->errors.total()) : Value{};
                       }});
}

void add_quantile_columns(std::vector<RunColumn<ErrorBin>>& columns, std::string_view group,
                          std::optional<Quantiles> ErrorBin::*values)
{
    columns.push_back({fmt::format("{}.count", group), integer_type, [values](const ErrorBin& bin) {
                           return bin.*values ? count((bin.*values)->count) : Value{};
                       }});
    for (const auto& [name, member] : {std::pair{"min", &Quantiles::min},
                                       {"median", &Quantiles::median},
                                       {"p95", &Quantiles::p95},
                                       {"max", &Quantiles::max}}) {
        columns.push_back({fmt::format("{}.{}", group, name), real_type,
                           [values, member = member](const ErrorBin& bin) {
                               return bin.*values ? finite((*(bin.*values)).*member) : Value{};
                           }});
    }
}

std::vector<JobColumn> job_columns_where(bool is_of_configuration)
{
    std::vector<JobColumn> columns;
    std::ranges::copy_if(job_columns(), std::back_inserter(columns), [&](const JobColumn& column) {
        return is_configuration_key(column.name) == is_of_configuration;
    });
    return columns;
}

/// What the double quotes of a TOML text hold.
std::string unquoted(const std::string& toml)
{
    if (toml.find('\\') == std::string::npos) {
        return toml.substr(1, toml.size() - 2);
    }
    const auto node = scene::parse_toml_value(toml);
    const auto* text = node ? std::get_if<std::string>(&node->value) : nullptr;
    return text != nullptr ? *text : toml;
}

/// The whole text as a number.
template <typename Number>
std::optional<Number> parsed(const std::string& text)
{
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && stop == end ? std::optional<Number>{value} : std::nullopt;
}

} // namespace

const std::vector<JobColumn>& job_columns()
{
    static const std::vector<JobColumn> columns = [] {
        std::vector<JobColumn> all;
        for (const scene::KeySpec& spec : scene::key_specs()) {
            all.push_back({spec.key.name, type_of(spec.domain)});
        }
        return all;
    }();
    return columns;
}

bool is_configuration_key(std::string_view key)
{
    return key == "scene.file" || scene::is_constant_bias(key);
}

const std::vector<JobColumn>& configuration_key_columns()
{
    static const std::vector<JobColumn> columns = job_columns_where(true);
    return columns;
}

const std::vector<JobColumn>& curve_key_columns()
{
    static const std::vector<JobColumn> columns = job_columns_where(false);
    return columns;
}

const CurveColumns& map_columns()
{
    static const CurveColumns columns{
        {"map_near_m", real_type, [](const CurveResult& curve) { return number(curve.near_m); }},
        {"map_far_m", real_type, [](const CurveResult& curve) { return number(curve.far_m); }},
        {"map_bytes", integer_type,
         [](const CurveResult& curve) {
             return curve.map_bytes ? count(*curve.map_bytes) : Value{};
         }},
        {"bias_source", text_type, [](const CurveResult& curve) {
             // Of another renderer whose map is not known nothing knows other biases.
             return curve.best || curve.map_bytes
                        ? Value{std::string{curve.best ? "curve" : "rerun"}}
                        : Value{};
         }}};
    return columns;
}

const ResultColumns& result_columns()
{
    static const ResultColumns columns = [] {
        ResultColumns all;
        add_class_columns(all);
        add_reason_columns(all);
        add_error_columns(all);
        add_counts_by_name(all, "causes", analysis::cause_names, &analysis::CauseCounts::by_cause);
        add_counts_by_name(all, "labels", analysis::label_names, &analysis::CauseCounts::by_label);
        add_gap_columns(all);
        return all;
    }();
    return columns;
}

const ResultColumns& part_columns()
{
    static const ResultColumns columns{
        {"errors_by_part", text_type, [](const ConfigurationResult& result) {
             return result.parts.empty() ? Value{} : Value{parts_json(result.parts).dump()};
         }}};
    return columns;
}

const CurveColumns& bias_curve_columns()
{
    static const CurveColumns columns = [] {
        CurveColumns all;
        add_best_columns(all);
        add_limit_columns(all, "bias_curve.", [](const BiasBounds& bounds) -> const BiasLimits& {
            return bounds.strict;
        });
        add_allowance_columns(all);
        all.push_back(
            {"bias_curve.no_constant_bias_serves", text_type, [](const CurveResult& curve) {
                 return curve.bounds ? flag(curve.bounds->no_constant_bias_serves) : Value{};
             }});
        return all;
    }();
    return columns;
}

const std::vector<RunColumn<ErrorBin>>& bin_columns()
{
    static const std::vector<RunColumn<ErrorBin>> columns = [] {
        std::vector<RunColumn<ErrorBin>> all{
            {"lower_m", real_type, [](const ErrorBin& bin) { return number(bin.lower); }},
            {"upper_m", real_type, [](const ErrorBin& bin) { return number(bin.upper); }},
            {"lit", integer_type, [](const ErrorBin& bin) { return count(bin.counts.lit); }},
            {"blocked", integer_type,
             [](const ErrorBin& bin) { return count(bin.counts.blocked); }},
            {"false_shadow", integer_type,
             [](const ErrorBin& bin) { return count(bin.counts.false_shadow); }},
            {"false_lit", integer_type,
             [](const ErrorBin& bin) { return count(bin.counts.false_lit); }}};
        add_quantile_columns(all, "needed_bias", &ErrorBin::needed_bias);
        add_quantile_columns(all, "map_error_m", &ErrorBin::map_error_m);
        all.push_back(
            {"envelope_m", real_type, [](const ErrorBin& bin) { return number(bin.envelope_m); }});
        return all;
    }();
    return columns;
}

Value job_cell(const std::string& toml)
{
    if (toml.starts_with('"')) {
        return unquoted(toml);
    }
    if (const auto integer = parsed<std::int64_t>(toml)) {
        return *integer;
    }
    if (const auto real = parsed<double>(toml)) {
        return *real;
    }
    return toml;
}

} // namespace gnomon::reports
