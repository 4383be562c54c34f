#include "store/baseline/configuration_text.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "scene/one_line.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace gnomon::store {

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

Json metric_json(std::string_view metric, const std::optional<double>& value)
{
    if (value && analysis::is_whole_metric(metric)) {
        return Json(static_cast<std::uint64_t>(*value));
    }
    return number_or_null(value);
}

} // namespace gnomon::store
