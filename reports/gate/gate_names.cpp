#include "reports/gate/gate_names.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "reports/text.hpp"
#include "scene/job/toml.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace gnomon::reports {

namespace {

bool is_whole(std::string_view name)
{
    const analysis::GateMetric* const metric = analysis::find_gate_metric(name);
    return metric != nullptr && metric->is_whole;
}

std::string number_text(std::string_view metric, double value)
{
    return is_whole(metric) ? grouped(static_cast<std::uint64_t>(value))
                            : fmt::format("{:.6g}", value);
}

} // namespace

std::string key_text(const analysis::ConfigurationKey& key)
{
    std::string text = key.case_name;
    for (const auto& [axis, value] : key.axes) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", axis, value);
    }
    return text.empty() ? "the only configuration" : scene::one_line(text);
}

Json key_json(const analysis::ConfigurationKey& key)
{
    Json axes = Json::object();
    for (const auto& [axis, value] : key.axes) {
        axes[axis] = value;
    }
    return {{"case", key.case_name}, {"axes", std::move(axes)}};
}

std::string filter_text(const analysis::PixelFilter& filter)
{
    std::string text;
    const auto add = [&](std::string_view name, std::string_view value) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
    };
    if (filter.object) {
        add("object", *filter.object);
    }
    if (filter.cause) {
        add("cause", analysis::cause_names[static_cast<std::size_t>(*filter.cause)]);
    }
    if (filter.label) {
        add("label", analysis::label_names[static_cast<std::size_t>(*filter.label)]);
    }
    if (filter.bands) {
        const auto& [first, last] = *filter.bands;
        add("zeta_band", fmt::format("[{}, {}) m", first.lower_m(), last.upper_m()));
    }
    return scene::one_line(text);
}

Json filter_json(const analysis::PixelFilter& filter)
{
    Json json = Json::object();
    if (filter.object) {
        json["object"] = *filter.object;
    }
    if (filter.cause) {
        json["cause"] = analysis::cause_names[static_cast<std::size_t>(*filter.cause)];
    }
    if (filter.label) {
        json["label"] = analysis::label_names[static_cast<std::size_t>(*filter.label)];
    }
    if (filter.bands) {
        const auto finite = [](double end_m) {
            return std::isfinite(end_m) ? Json(end_m) : Json(nullptr);
        };
        json["zeta_band"] = {finite(filter.bands->first.lower_m()),
                             finite(filter.bands->last.upper_m())};
    }
    return json;
}

std::string metric_text(std::string_view metric, const std::optional<double>& value)
{
    return value ? number_text(metric, *value) : "-";
}

std::string change_text(std::string_view metric, const std::optional<double>& before,
                        const std::optional<double>& now)
{
    if (!before || !now) {
        return {};
    }
    const double change = *now - *before;
    return fmt::format("{}{}", change < 0 ? '-' : '+', number_text(metric, std::abs(change)));
}

Json metric_json(std::string_view metric, const std::optional<double>& value)
{
    if (value && is_whole(metric)) {
        return Json(static_cast<std::uint64_t>(*value));
    }
    return number_or_null(value);
}

std::string change_line(const analysis::ParameterChange& change)
{
    return scene::one_line(fmt::format("{}: {} -> {}", change.key, change.before.value_or("none"),
                                       change.now.value_or("none")));
}

std::string renderer_text(const analysis::Environment& environment)
{
    return scene::one_line(fmt::format("{}, {}, {}", environment.gl_renderer,
                                       environment.gl_version, environment.embree));
}

std::string_view reason_code(analysis::GateReason reason)
{
    switch (reason) {
    case analysis::GateReason::above_max:
        return "above_max";
    case analysis::GateReason::below_min:
        return "below_min";
    case analysis::GateReason::worse_than_baseline:
        return "worse_than_baseline";
    case analysis::GateReason::nothing_tested:
        return "nothing_tested";
    case analysis::GateReason::traded_off:
        return "traded_off";
    case analysis::GateReason::not_available:
        break;
    }
    return "not_available";
}

} // namespace gnomon::reports
