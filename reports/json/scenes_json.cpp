#include "reports/json/scenes_json.hpp"

#include "store/json_values.hpp"

#include <cmath>
#include <cstdint>

namespace gnomon::reports {

namespace {

/// A whole number without a fraction where the parameter counts; null where a range has no end.
store::Json number(double value, bool is_integer)
{
    if (!std::isfinite(value)) {
        return nullptr;
    }
    return is_integer ? store::Json(static_cast<std::int64_t>(value)) : store::Json(value);
}

store::Json parameter_object(const scene::BuiltinParameter& parameter)
{
    store::Json json{
        {"name", parameter.name}, {"description", parameter.description}, {"unit", parameter.unit}};
    if (const auto* word = std::get_if<std::string>(&parameter.default_value)) {
        json["type"] = "word";
        json["default"] = *word;
        json["words"] = parameter.words;
        return json;
    }
    const double default_value = std::get<double>(parameter.default_value);
    json["type"] = parameter.is_integer ? "integer" : "number";
    json["default"] = number(default_value, parameter.is_integer);
    json["range"] = {number(parameter.lower, parameter.is_integer),
                     number(parameter.upper, parameter.is_integer)};
    return json;
}

} // namespace

std::string scenes_json(std::span<const scene::BuiltinScene> scenes)
{
    store::Json json = store::Json::array();
    for (const scene::BuiltinScene& scene : scenes) {
        store::Json parameters = store::Json::array();
        for (const scene::BuiltinParameter& parameter : scene.parameters) {
            parameters.push_back(parameter_object(parameter));
        }
        json.push_back({{"name", scene.name},
                        {"description", scene.description},
                        {"origin", scene.origin},
                        {"parameters", std::move(parameters)}});
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
