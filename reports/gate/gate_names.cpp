#include "reports/gate/gate_names.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "reports/text/text.hpp"
#include "scene/one_line.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace gnomon::reports {

namespace {

std::string number_text(std::string_view metric, double value)
{
    return analysis::is_whole_metric(metric) ? grouped(static_cast<std::uint64_t>(value))
                                             : fmt::format("{:.6g}", value);
}

} // namespace

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

store::Json filter_json(const analysis::PixelFilter& filter)
{
    store::Json json = store::Json::object();
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
            return std::isfinite(end_m) ? store::Json(end_m) : store::Json(nullptr);
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
