#include "reports/settings/settings_text.hpp"

#include "analysis/advice/remedies.hpp"
#include "analysis/comparison/comparison.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
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

using analysis::ChosenBias;
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
std::string_view bias_name(const ChosenBias& light)
{
    if (light.is_recommended) {
        return "the recommended bias";
    }
    return light.was_recommended ? "the job's own bias, because no other that it can have is better"
                                 : "the job's own bias";
}

/// The errors of Gnomon's own map, or why they are unknown.
/// @param title  of what may lack a bias of the job.
std::string errors_text(const ChosenBias& light, std::string_view title)
{
    if (!light.has_all_biases) {
        return fmt::format("{} lacks a bias of the job, so Gnomon cannot tell the errors.\n",
                           title);
    }
    return fmt::format("Gnomon's own map with this bias {}.\n",
                       error_rates_text(light.false_shadow_rate, light.false_lit_rate));
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

/// "three.js, light sun, with the recommended bias:"
std::string heading(std::string_view title, const ChosenBias& light)
{
    return fmt::format("{}{}, with {}:\n\n", title,
                       light.light.empty() ? "" : fmt::format(", light {}", light.light),
                       bias_name(light));
}

/// "three.js has no setting for lookup.filter = \"pcf3\"."
std::string cannot_text(std::string_view title, std::string_view what,
                        const std::vector<std::string>& cannot)
{
    return cannot.empty()
               ? std::string{}
               : fmt::format("{} has no {} for {}.\n", title, what, fmt::join(cannot, "; "));
}

std::string light_text(const EngineSettings& light)
{
    const scene::Engine& engine = *light.preset->engine;
    return heading(engine.title, light) + lines_of(light, "  ") + "\n" +
           errors_text(light, "The engine") + map_text(light) +
           cannot_text(engine.title, "setting", light.cannot) +
           fmt::format("{} {}; its settings: {}\n", engine.title, engine.version,
                       engine.documentation);
}

std::string light_text(const GraphicsSettings& light)
{
    const std::string_view title = graphics_target_title(light.target);
    std::string text = heading(title, light);
    for (const std::string& line : light.lines) {
        text += line.empty() ? "\n" : fmt::format("  {}\n", line);
    }
    text += "\n" + errors_text(light, "The code") + cannot_text("The code", "line", light.cannot);
    const bool is_shader =
        light.target == GraphicsTarget::glsl || light.target == GraphicsTarget::hlsl;
    return is_shader ? text + "Draw the map with the states of --engine gl, direct3d or vulkan.\n"
                     : text;
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

store::Json light_json(const EngineSettings& light)
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

store::Json light_json(const GraphicsSettings& light)
{
    return {{"engine", graphics_target_names()[static_cast<std::size_t>(light.target)]},
            {"title", graphics_target_title(light.target)},
            {"light", light.light.empty() ? store::Json(nullptr) : store::Json(light.light)},
            {"recommended", light.is_recommended},
            {"lines", light.lines},
            {"text", fmt::format("{}\n", fmt::join(light.lines, "\n"))},
            {"cannot", light.cannot},
            {"false_shadow_rate", store::number_or_null(light.false_shadow_rate)},
            {"false_lit_rate", store::number_or_null(light.false_lit_rate)}};
}

/// "Configuration 3f2a of case sun: shadow_map.resolution = 2048."
std::string configuration_text(const TranslatedSettings& translated)
{
    if (translated.configuration.empty()) {
        return {};
    }
    return fmt::format(
        "Configuration {}{}{}.\n", translated.configuration,
        translated.case_name.empty() ? "" : fmt::format(" of case {}", translated.case_name),
        translated.changed.empty() ? "" : ": " + translated.changed);
}

} // namespace

std::string error_rates_text(const std::optional<double>& false_shadow,
                             const std::optional<double>& false_lit)
{
    std::vector<std::string> parts;
    if (false_shadow) {
        parts.push_back(fmt::format("shadows {} of the lit pixels", percent(false_shadow)));
    }
    if (false_lit) {
        parts.push_back(fmt::format("lights {} of the shadowed ones", percent(false_lit)));
    }
    return fmt::format("{}", fmt::join(parts, " and "));
}

store::Json settings_object(const TranslatedSettings& translated)
{
    store::Json json =
        std::visit([](const auto& light) { return light_json(light); }, translated.settings);
    if (!translated.configuration.empty()) {
        json["configuration"] = translated.configuration;
        json["case"] =
            translated.case_name.empty() ? store::Json(nullptr) : store::Json(translated.case_name);
    }
    return json;
}

namespace {

/// All presets; none for a program without the methods whose keys they set.
std::vector<scene::Preset> presets_of(const scene::KeyTable& keys)
{
    try {
        return scene::presets(keys);
    } catch (const scene::InputError&) {
        return {};
    }
}

} // namespace

std::vector<SettingsTarget> settings_targets(const scene::KeyTable& keys)
{
    std::vector<SettingsTarget> targets;
    for (scene::Preset& preset : presets_of(keys)) {
        if (preset.engine) {
            targets.emplace_back(std::move(preset));
        }
    }
    for (const std::string_view name : graphics_target_names()) {
        targets.emplace_back(*graphics_target_from_name(name));
    }
    return targets;
}

std::vector<std::string> settings_target_names()
{
    std::vector<std::string> names = scene::engine_names();
    names.insert(names.end(), graphics_target_names().begin(), graphics_target_names().end());
    return names;
}

SettingsTarget find_settings_target(const scene::KeyTable& keys, std::string_view name,
                                    std::string_view label)
{
    if (const auto target = graphics_target_from_name(name)) {
        return *target;
    }
    return scene::find_engine(keys, name, label, graphics_target_names());
}

namespace {

using analysis::BiasChoice;

/// The biases that a remedy sets; empty if it changes other keys, or was measured by a rerun.
std::optional<BiasChoice> choice_of(const analysis::Comparison& comparison,
                                    const analysis::Remedy& remedy)
{
    const analysis::Diagnosis& diagnosis = *comparison.diagnosis;
    const auto& recommended = diagnosis.curve.recommended;
    if (remedy.measured_by == analysis::MeasuredBy::curve && recommended) {
        return BiasChoice{&*recommended, {}, true};
    }
    if (remedy.measured_by != analysis::MeasuredBy::slope_curve || !diagnosis.biases) {
        return std::nullopt;
    }
    for (const analysis::SlopeAnswer& answer : diagnosis.biases->slopes) {
        if (answer.recommended &&
            remedy.keys.front() == fmt::format("bias.slope = {}", answer.slope)) {
            return BiasChoice{&*answer.recommended, answer.slope, true};
        }
    }
    return std::nullopt;
}

/// The remedies that change only biases, the best first, then the job's own biases.
std::vector<BiasChoice> bias_choices(const analysis::Comparison& comparison, bool recommends)
{
    std::vector<BiasChoice> choices;
    if (recommends && comparison.diagnosis) {
        for (const analysis::Remedy& remedy : analysis::ranked_remedies(comparison)) {
            if (const auto choice = choice_of(comparison, remedy)) {
                choices.push_back(*choice);
            }
        }
    }
    choices.push_back({nullptr, {}, recommends});
    return choices;
}

std::variant<analysis::EngineSettings, GraphicsSettings>
translate(const SettingsTarget& target, const analysis::Comparison& comparison,
          const BiasChoice& choice)
{
    if (const auto* graphics = std::get_if<GraphicsTarget>(&target)) {
        return graphics_settings(*graphics, comparison, choice);
    }
    return analysis::engine_settings(std::get<scene::Preset>(target), comparison, choice);
}

} // namespace

TranslatedSettings translate(const SettingsTarget& target, const analysis::Comparison& comparison,
                             bool recommends)
{
    const std::vector<BiasChoice> choices = bias_choices(comparison, recommends);
    for (const BiasChoice& choice : choices) {
        TranslatedSettings translated{translate(target, comparison, choice)};
        const bool is_whole =
            std::visit([](const analysis::ChosenBias& chosen) { return chosen.has_all_biases; },
                       translated.settings);
        if (is_whole) {
            return translated;
        }
    }
    return {translate(target, comparison, choices.front())};
}

std::string settings_text(std::span<const TranslatedSettings> translated)
{
    std::string text;
    for (const TranslatedSettings& one : translated) {
        text += text.empty() ? "" : "\n";
        text += configuration_text(one) +
                std::visit([](const auto& light) { return light_text(light); }, one.settings);
    }
    return text;
}

std::string settings_json(std::span<const TranslatedSettings> translated)
{
    store::Json json = store::Json::array();
    for (const TranslatedSettings& one : translated) {
        json.push_back(settings_object(one));
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
