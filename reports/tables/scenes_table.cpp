#include "reports/tables/scenes_table.hpp"

#include "reports/text/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

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

} // namespace gnomon::reports
