#include "reports/text/engine_settings_text.hpp"

#include "reports/text/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

namespace gnomon::reports {
namespace {

using analysis::EngineSettings;
using analysis::EngineValue;

/// Whole and large numbers without a fraction, others with three digits.
std::string number_text(double value)
{
    const bool is_whole = value == std::nearbyint(value) || std::abs(value) >= 1000;
    return is_whole && std::abs(value) < 1e9 ? fmt::format("{:.0f}", value)
                                             : fmt::format("{:.3g}", value);
}

std::string value_text(const EngineValue& value)
{
    const auto* word = std::get_if<std::string>(&value.value);
    return word != nullptr ? *word : number_text(std::get<double>(value.value));
}

/// The line to paste: the value in place of each `{}`.
std::string line_of(const EngineValue& value)
{
    std::string line = value.setting->line;
    const std::string text = value_text(value);
    for (auto at = line.find("{}"); at != std::string::npos; at = line.find("{}", at)) {
        line.replace(at, 2, text);
        at += text.size();
    }
    return line;
}

/// "0.071 m", or in the scene's own units where a file's unit is given.
std::string length_text(double metres, const EngineSettings& light)
{
    return light.unit_m == 1 ? fmt::format("{:.3g} {}", metres, light.unit)
                             : fmt::format("{} units", number_text(metres / light.unit_m));
}

/// "against acne it is negative; 0.071 m"
std::string comment_of(const EngineValue& value, const EngineSettings& light)
{
    std::string comment = value.setting->about;
    if (value.length_m != 0) {
        comment +=
            fmt::format("{}{}", comment.empty() ? "" : "; ", length_text(value.length_m, light));
    }
    return comment;
}

/// One setting a line, with its comment.
std::string lines_of(const EngineSettings& light, std::string_view indent)
{
    constexpr std::size_t widest = 60; // longer lines have their comment right behind
    std::vector<std::string> lines;
    std::size_t width = 0;
    for (const EngineValue& value : light.values) {
        lines.push_back(line_of(value));
        width = lines.back().size() <= widest ? std::max(width, lines.back().size()) : width;
    }
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string comment = comment_of(light.values[i], light);
        text += comment.empty() ? fmt::format("{}{}\n", indent, lines[i])
                                : fmt::format("{}{}  {} {}\n", indent, pad_right(lines[i], width),
                                              light.preset->engine->comment, comment);
    }
    for (const std::string& line : light.preset->engine->also) {
        text += fmt::format("{}{}\n", indent, line);
    }
    return text;
}

/// "the recommended bias"
std::string_view bias_name(const EngineSettings& light)
{
    if (light.is_recommended) {
        return "the recommended bias";
    }
    return light.was_recommended ? "the job's own bias, because none can be recommended"
                                 : "the job's own bias";
}

/// The errors of Gnomon's own map, or why they are unknown.
std::string errors_text(const EngineSettings& light)
{
    if (!light.has_all_biases) {
        return "The engine lacks a bias of the job, so Gnomon cannot tell the errors.\n";
    }
    std::vector<std::string> parts;
    if (light.false_shadow_rate) {
        parts.push_back(
            fmt::format("shadows {} of the lit pixels", percent(light.false_shadow_rate)));
    }
    if (light.false_lit_rate) {
        parts.push_back(
            fmt::format("lights {} of the shadowed ones", percent(light.false_lit_rate)));
    }
    return fmt::format("Gnomon's own map with this bias {}.\n", fmt::join(parts, " and "));
}

/// The map's size, on which biases in depth units and in texels depend.
std::string map_text(const EngineSettings& light)
{
    const std::string size = fmt::format("{} x {}", length_text(light.width_m, light),
                                         length_text(light.height_m, light));
    if (light.is_positional) {
        return fmt::format("Lengths hold {} from the light, where the map is {} wide and high.\n",
                           length_text(light.receiver.light_distance_m, light), size);
    }
    const std::string which =
        light.maps == 1 ? "The map"
                        : fmt::format("Cascade {}, which most pixels read,", light.receiver.map);
    return fmt::format("{} spans {}, and {} along the light; let the engine's span as much.\n",
                       which, size, length_text(light.range_m, light));
}

std::string light_text(const EngineSettings& light)
{
    const scene::Engine& engine = *light.preset->engine;
    std::string text = fmt::format(
        "{}{}, with {}:\n\n", engine.title,
        light.light.empty() ? "" : fmt::format(", light {}", light.light), bias_name(light));
    text += lines_of(light, "  ") + "\n" + errors_text(light) + map_text(light);
    if (!light.cannot.empty()) {
        text +=
            fmt::format("{} has no setting for {}.\n", engine.title, fmt::join(light.cannot, "; "));
    }
    return text + fmt::format("{} {}; its settings: {}\n", engine.title, engine.version,
                              engine.documentation);
}

store::Json value_json(const EngineValue& value)
{
    const auto* number = std::get_if<double>(&value.value);
    if (number == nullptr) {
        return std::get<std::string>(value.value);
    }
    const double whole = std::nearbyint(*number);
    return whole == *number && std::abs(whole) < 1e9 ? store::Json(static_cast<std::int64_t>(whole))
                                                     : store::Json(*number);
}

} // namespace

store::Json engine_settings_object(const EngineSettings& light)
{
    const scene::Engine& engine = *light.preset->engine;
    store::Json values = store::Json::array();
    for (const EngineValue& value : light.values) {
        values.push_back({{"name", value.setting->name},
                          {"key", value.setting->key->name},
                          {"value", value_json(value)},
                          {"line", line_of(value)},
                          {"about", value.setting->about},
                          {"length_m", value.length_m == 0 ? store::Json(nullptr)
                                                           : store::Json(value.length_m)}});
    }
    return {{"engine", light.preset->name},
            {"title", engine.title},
            {"version", engine.version},
            {"documentation", engine.documentation},
            {"light", light.light.empty() ? store::Json(nullptr) : store::Json(light.light)},
            {"recommended", light.is_recommended},
            {"settings", std::move(values)},
            {"also", engine.also},
            {"text", lines_of(light, "")},
            {"cannot", light.cannot},
            {"positional", light.is_positional},
            {"map", light.receiver.map},
            {"light_distance_m", light.receiver.light_distance_m},
            {"width_m", light.width_m},
            {"height_m", light.height_m},
            {"range_m", light.range_m},
            {"false_shadow_rate", store::number_or_null(light.false_shadow_rate)},
            {"false_lit_rate", store::number_or_null(light.false_lit_rate)}};
}

std::string engine_settings_text(const std::vector<EngineSettings>& lights)
{
    std::string text;
    for (const EngineSettings& light : lights) {
        text += text.empty() ? "" : "\n";
        text += light_text(light);
    }
    return text;
}

std::string engine_settings_json(const std::vector<EngineSettings>& lights)
{
    store::Json json = store::Json::array();
    for (const EngineSettings& light : lights) {
        json.push_back(engine_settings_object(light));
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
