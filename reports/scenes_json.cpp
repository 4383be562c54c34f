#include "reports/scenes_json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::reports {

namespace {

using Json = nlohmann::ordered_json;

/// A whole number without a fraction where the parameter counts; null where a range has no end.
Json number(double value, bool is_integer)
{
    if (!std::isfinite(value)) {
        return nullptr;
    }
    return is_integer ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

Json parameter_object(const scene::BuiltinParameter& parameter)
{
    Json json{
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
    Json json = Json::array();
    for (const scene::BuiltinScene& scene : scenes) {
        Json parameters = Json::array();
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
