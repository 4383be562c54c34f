#include "reports/catalogue/catalogue.hpp"

#include "reports/text/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gnomon::reports {

namespace {

std::string value_text(const scene::SceneParameter& value)
{
    if (const auto* word = std::get_if<std::string>(&value)) {
        return *word;
    }
    return fmt::format("{}", std::get<double>(value));
}

std::string allowed_text(const scene::BuiltinParameter& parameter)
{
    if (std::holds_alternative<std::string>(parameter.default_value)) {
        return fmt::format("{}", fmt::join(parameter.words, " | "));
    }
    return fmt::format("{} to {}{}", parameter.lower, parameter.upper,
                       parameter.unit.empty() ? "" : " " + parameter.unit);
}

std::size_t longest_scene_name(std::span<const scene::BuiltinScene> scenes)
{
    std::size_t columns = 0;
    for (const scene::BuiltinScene& scene : scenes) {
        columns = std::max(columns, text_columns(scene.name));
        for (const scene::BuiltinParameter& parameter : scene.parameters) {
            columns = std::max(columns, text_columns(parameter.name) + 2);
        }
    }
    return columns + 2;
}

} // namespace

std::string scenes_table(std::span<const scene::BuiltinScene> scenes)
{
    const std::size_t columns = longest_scene_name(scenes);
    std::string text;
    for (const scene::BuiltinScene& scene : scenes) {
        text += pad_right(scene.name, columns) + scene.description + "\n";
        for (const scene::BuiltinParameter& parameter : scene.parameters) {
            text += pad_right("  " + parameter.name, columns) +
                    fmt::format("{} (default {}; {})\n", parameter.description,
                                value_text(parameter.default_value), allowed_text(parameter));
        }
    }
    return text;
}

namespace {

/// An integer for counts; null for an open end of a range.
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
