#include "store/run/run_columns.hpp"

#include "analysis/results/metric_table.hpp"
#include "methods/key_table.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/job/toml.hpp"
#include "store/json_values.hpp"
#include "store/run/error_buckets_json.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_types.hpp"
#include "store/sqlite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

namespace gnomon::store {

namespace {

using analysis::ConfigurationResult;
using analysis::CurveResult;
using analysis::CurveSample;
using analysis::ErrorBin;
using analysis::MapResult;
using analysis::Quantiles;
using sqlite::sql_name;
using sqlite::Value;

using CurveColumns = std::vector<RunColumn<CurveResult>>;
using ResultColumns = std::vector<RunColumn<ConfigurationResult>>;

constexpr std::string_view integer_type = "INTEGER";
constexpr std::string_view real_type = "REAL";
constexpr std::string_view text_type = "TEXT";

Value count(std::uint64_t value)
{
    return static_cast<std::int64_t>(value);
}
Value number(const std::optional<double>& value)
{
    return value ? Value{*value} : Value{};
}
Value finite(float value)
{
    return std::isfinite(value) ? Value{double{value}} : Value{};
}

std::string_view type_of(const scene::Domain& domain)
{
    if (std::holds_alternative<scene::IntegerDomain>(domain)) {
        return integer_type;
    }
    return std::holds_alternative<scene::RealDomain>(domain) ? real_type : text_type;
}

std::string_view type_of(analysis::MetricType type)
{
    switch (type) {
    case analysis::MetricType::count:
        return integer_type;
    case analysis::MetricType::number:
        return real_type;
    case analysis::MetricType::flag:
        return text_type;
    }
    throw std::invalid_argument("type_of: type: not a MetricType");
}

/// NULL for a metric without a value.
Value cell(const analysis::MetricValue& value)
{
    struct ToValue {
        Value operator()(std::monostate /*none*/) const { return {}; }
        Value operator()(std::uint64_t number) const { return count(number); }
        Value operator()(double number) const { return number; }
        Value operator()(bool is_true) const { return std::string{is_true ? "true" : "false"}; }
    };
    return std::visit(ToValue{}, value);
}

template <typename Source>
std::vector<RunColumn<Source>> columns_of(const std::vector<analysis::Metric<Source>>& metrics)
{
    std::vector<RunColumn<Source>> columns;
    for (const analysis::Metric<Source>& metric : metrics) {
        columns.push_back({metric.name, type_of(metric.type),
                           [&metric](const Source& source) { return cell(metric.value(source)); }});
    }
    return columns;
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

/// The content of a quoted TOML string.
std::string unquoted(const std::string& toml)
{
    if (toml.find('\\') == std::string::npos) {
        return toml.substr(1, toml.size() - 2);
    }
    const auto node = scene::parse_toml_value(toml);
    const auto* text = node ? std::get_if<std::string>(&node->value) : nullptr;
    return text != nullptr ? *text : toml;
}

/// The number, if the whole text is one.
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
        for (const scene::Key& spec : methods::key_table()->rows()) {
            // Only runs of the renderer that has these keys get columns for them.
            if (!scene::is_engine_key(spec.name)) {
                all.push_back({spec.name, type_of(spec.domain)});
            }
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
    static const CurveColumns columns = [] {
        CurveColumns all = columns_of(analysis::map_metrics());
        all.push_back({"bias_source", text_type, [](const CurveResult& curve) {
                           // Other biases are unknown for a renderer whose map is unknown.
                           return curve.best || curve.map_bytes
                                      ? Value{std::string{curve.best ? "curve" : "rerun"}}
                                      : Value{};
                       }});
        return all;
    }();
    return columns;
}

const ResultColumns& result_columns()
{
    static const ResultColumns columns = columns_of(analysis::configuration_metrics());
    return columns;
}

const ResultColumns& error_bucket_columns()
{
    static const ResultColumns columns{
        {"errors_by_part", text_type, [](const ConfigurationResult& result) {
             return result.cells.empty() ? Value{} : Value{error_buckets_json(result.cells).dump()};
         }}};
    return columns;
}

const CurveColumns& bias_curve_columns()
{
    static const CurveColumns columns = columns_of(analysis::curve_metrics());
    return columns;
}

const std::vector<RunColumn<MapResult>>& map_error_columns()
{
    static const std::vector<RunColumn<MapResult>> columns = [] {
        std::vector<RunColumn<MapResult>> all{
            {"map", text_type, [](const MapResult& map) { return Value{map.facts.name}; }},
            {"near_m", real_type, [](const MapResult& map) { return Value{map.facts.near_m}; }},
            {"far_m", real_type, [](const MapResult& map) { return Value{map.facts.far_m}; }},
            {"texel_m", real_type, [](const MapResult& map) { return Value{map.facts.texel_m}; }},
            {"begin_m", real_type, [](const MapResult& map) { return number(map.facts.begin_m); }},
            {"end_m", real_type, [](const MapResult& map) { return number(map.facts.end_m); }},
            {"bias_m", real_type, [](const MapResult& map) {
                 return map.facts.bias ? Value{map.facts.bias->constant_m} : Value{};
             }}};
        for (const analysis::SubsetQuantity& quantity : analysis::subset_quantities()) {
            all.push_back({std::string{quantity.name}, type_of(quantity.type),
                           [value = quantity.value](const MapResult& map) {
                               return cell(value(map.errors.counts));
                           }});
        }
        for (std::size_t cause = 1; cause < analysis::cause_names.size(); ++cause) {
            all.push_back({fmt::format("causes.{}", analysis::cause_names[cause]), integer_type,
                           [cause](const MapResult& map) {
                               return count(map.errors.causes.by_cause[cause]);
                           }});
        }
        return all;
    }();
    return columns;
}

const std::vector<RunColumn<CurveSample>>& point_columns()
{
    static const std::vector<RunColumn<CurveSample>> columns = [] {
        std::vector<RunColumn<CurveSample>> all{
            {"bias", real_type, [](const CurveSample& at) { return Value{double{at.bias}}; }}};
        for (const analysis::SubsetQuantity& quantity : analysis::subset_errors()) {
            all.push_back({std::string{quantity.name}, type_of(quantity.type),
                           [value = quantity.value](const CurveSample& at) {
                               return cell(value(at.counts));
                           }});
        }
        return all;
    }();
    return columns;
}

const std::vector<RunColumn<ErrorBin>>& bin_columns()
{
    static const std::vector<RunColumn<ErrorBin>> columns = [] {
        std::vector<RunColumn<ErrorBin>> all{
            {"lower_m", real_type, [](const ErrorBin& bin) { return number(bin.lower); }},
            {"upper_m", real_type, [](const ErrorBin& bin) { return number(bin.upper); }}};
        for (const analysis::SubsetQuantity& quantity : analysis::subset_quantities()) {
            all.push_back({std::string{quantity.name}, type_of(quantity.type),
                           [value = quantity.value](const ErrorBin& bin) {
                               return cell(value(bin.counts));
                           }});
        }
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

std::vector<std::string> light_columns(const std::vector<std::string>& axes)
{
    std::vector<std::string> columns;
    for (const std::string& axis : axes) {
        if (std::ranges::find(job_columns(), axis, &JobColumn::name) == job_columns().end()) {
            columns.push_back(axis);
        }
    }
    std::ranges::sort(columns);
    return columns;
}

std::vector<std::string> light_columns(const sqlite::Database& database)
{
    std::vector<std::string> keys = read_axes(database);
    for (std::string& key : read_engine_keys(database)) {
        if (std::ranges::find(keys, key) == keys.end()) {
            keys.push_back(std::move(key));
        }
    }
    return light_columns(keys);
}

std::vector<ResultsColumn> results_columns(const std::vector<std::string>& light_columns)
{
    using Of = ResultsColumn::Of;
    std::vector<ResultsColumn> all{{"schema", fmt::format("{}", run_schema), Of::curve},
                                   {"ordinal", "p.ordinal", Of::configuration},
                                   {"id", "c.id", Of::configuration},
                                   {"curve", "k.id", Of::curve},
                                   {"case", "p.\"case\"", Of::configuration},
                                   {"status", "c.status", Of::configuration},
                                   {"message", "c.message", Of::configuration},
                                   {"scene_hash", "k.scene_hash", Of::curve}};
    for (const std::string& column : light_columns) {
        const auto after_case = std::ranges::find(all, "status", &ResultsColumn::name);
        all.insert(after_case,
                   {column, fmt::format("json_extract(p.light_values, '$.\"{}\"')", column),
                    Of::configuration});
    }
    const auto add = [&](const auto& columns, std::string_view table, Of of) {
        for (const auto& column : columns) {
            all.push_back({column.name, fmt::format("{}.{}", table, sql_name(column.name)), of});
        }
    };
    for (const JobColumn& column : job_columns()) {
        const bool is_own = is_configuration_key(column.name);
        add(std::array{column}, is_own ? "c" : "k", is_own ? Of::configuration : Of::curve);
    }
    add(map_columns(), "v", Of::curve);
    add(result_columns(), "c", Of::configuration);
    add(bias_curve_columns(), "v", Of::curve);
    return all;
}

std::string results_tables()
{
    return "part p CROSS JOIN configurations c ON c.number = p.configuration"
           " JOIN curves k ON k.number = c.curve"
           " LEFT JOIN curves v ON v.number = c.curve AND c.status = 'done'";
}

} // namespace gnomon::store
