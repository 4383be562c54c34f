#include "reports/text/engine_settings_text.hpp"

#include "reports/text/text.hpp"
#include "store/json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gnomon::reports {
namespace {

using analysis::EngineSettings;
using analysis::EngineValue;

/// Whole numbers in full, others with three digits.
std::string number_text(double value)
{
    return value == std::nearbyint(value) && std::abs(value) < 1e6 ? fmt::format("{:.0f}", value)
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

/// "added to the depth of what is lit; 0.013 m at far - near = 41.9 m"
std::string comment_of(const EngineValue& value, const EngineSettings& light)
{
    std::string comment = value.setting->about;
    if (value.length_m != 0) {
        comment +=
            fmt::format("{}{:.2g} {} while far - near is {:.3g} {}", comment.empty() ? "" : "; ",
                        value.length_m, light.unit, light.range_m, light.unit);
    }
    return comment;
}

std::string lines_of(const EngineSettings& light)
{
    std::vector<std::string> lines;
    std::size_t width = 0;
    for (const EngineValue& value : light.values) {
        lines.push_back(line_of(value));
        width = std::max(width, lines.back().size());
    }
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string comment = comment_of(light.values[i], light);
        text += comment.empty() ? fmt::format("  {}\n", lines[i])
                                : fmt::format("  {}  {} {}\n", pad_right(lines[i], width),
                                              light.preset->engine->comment, comment);
    }
    return text;
}

std::string light_text(const EngineSettings& light)
{
    const scene::Engine& engine = *light.preset->engine;
    std::string text =
        fmt::format("{}{}, with {}:\n\n", engine.title,
                    light.light.empty() ? "" : fmt::format(", light {}", light.light),
                    light.is_recommended ? "the recommended bias" : "the job's own bias");
    text += lines_of(light);
    text +=
        fmt::format("\nGnomon's map with this bias shadows {:.2g} % of the lit pixels and lights "
                    "{:.2g} % of the shadowed ones.\n",
                    100 * light.false_shadow_rate, 100 * light.false_lit_rate);
    if (!light.is_exact) {
        text += fmt::format("Lengths hold at the median receiver, {:.3g} {} from the light.\n",
                            light.light_distance_m, light.unit);
    }
    if (!light.cannot.empty()) {
        text +=
            fmt::format("{} has no setting for {}.\n", engine.title, fmt::join(light.cannot, "; "));
    }
    return text + fmt::format("Checked with {} {}; documented at {}\n", engine.title,
                              engine.version, engine.documentation);
}

store::Json light_json(const EngineSettings& light)
{
    const scene::Engine& engine = *light.preset->engine;
    store::Json values = store::Json::array();
    for (const EngineValue& value : light.values) {
        store::Json json{
            {"name", value.setting->name},
            {"key", value.setting->key->name},
            {"line", line_of(value)},
            {"about", value.setting->about},
            {"length_m", value.length_m == 0 ? store::Json(nullptr) : store::Json(value.length_m)}};
        std::visit([&](const auto& own) { json["value"] = own; }, value.value);
        values.push_back(std::move(json));
    }
    return {{"engine", light.preset->name},
            {"title", engine.title},
            {"version", engine.version},
            {"documentation", engine.documentation},
            {"light", light.light.empty() ? store::Json(nullptr) : store::Json(light.light)},
            {"recommended", light.is_recommended},
            {"settings", std::move(values)},
            {"cannot", light.cannot},
            {"exact", light.is_exact},
            {"light_distance_m", light.light_distance_m},
            {"false_shadow_rate", light.false_shadow_rate},
            {"false_lit_rate", light.false_lit_rate}};
}

} // namespace

std::string engine_settings_text(const std::vector<EngineSettings>& lights)
{
    std::string text;
    for (const EngineSettings& light : lights) {
        text += (text.empty() ? "" : "\n") + light_text(light);
    }
    return text;
}

std::string engine_settings_json(const std::vector<EngineSettings>& lights)
{
    store::Json json = store::Json::array();
    for (const EngineSettings& light : lights) {
        json.push_back(light_json(light));
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
