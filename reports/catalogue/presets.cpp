#include "reports/catalogue/catalogue.hpp"

#include "reports/tables/table_lines.hpp"
#include "reports/text/text.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

using PresetRow = std::vector<std::string>;

constexpr std::string_view nothing_there = "-";

std::string lights_text(const scene::Preset& preset)
{
    std::string text;
    for (const scene::LightType light : preset.lights) {
        text += fmt::format("{}{}", text.empty() ? "" : ", ", scene::light_type_name(light));
    }
    return text;
}

std::string keys_text(const scene::Layer& layer)
{
    std::string text;
    for (const scene::Setting& setting : layer) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", setting.spec->name,
                            scene::to_toml(setting.value));
    }
    return text;
}

std::string list_line(std::string_view name, std::string_view text)
{
    return fmt::format("  {}{}\n", pad_right(name, 10), text);
}

std::string preset_text(const scene::Preset& preset)
{
    std::string text = fmt::format("{}: {}\n\n", preset.name, preset.sentence);
    text += list_line("source", preset.source);
    text += list_line("lights", lights_text(preset));
    text += list_line("own bias", preset.own_bias);
    text += list_line("keys", keys_text(preset.job));
    if (!preset.own_scene.empty()) {
        text += list_line("scene", keys_text(preset.own_scene));
    }
    std::string_view name = "cannot";
    for (const std::string& line : preset.cannot) {
        text += list_line(name, line);
        name = "";
    }
    return text;
}

std::string digits(double value)
{
    return fmt::format("{:.4g}", plain_zero(value));
}

/// The map's size and format, and its number of layers if there are several.
std::string map_text(const scene::Job& job)
{
    const std::size_t maps = scene::map_count(job);
    const int texels = job.shadow_map.resolution_texels;
    const std::string format = scene::depth_format_name(job.shadow_map.depth_format);
    return maps == 1 ? fmt::format("{0}x{0} {1}", texels, format)
                     : fmt::format("{2} of {0}x{0} {1}", texels, format, maps);
}

std::string preset_filter_text(const scene::Job& job)
{
    return scene::has_filters(job) ? std::string{scene::filter_name(job.lookup.filter)}
                                   : job.method.name;
}

std::string preset_label(const analysis::PresetResult& result)
{
    return result.preset == nullptr ? "the job" : result.preset->name;
}

PresetRow bias_row(const analysis::PresetResult& result)
{
    PresetRow row{preset_label(result), map_text(result.job), preset_filter_text(result.job)};
    if (!result.receiver) {
        row.insert(row.end(), 6, std::string{nothing_there});
    } else {
        const analysis::ReceiverBias& at = *result.receiver;
        for (const double value : {at.bias.constant, at.bias.constant_m, at.bias.constant_texels,
                                   at.constant_r, at.slope, at.normal_texels}) {
            row.push_back(digits(value));
        }
    }
    return row;
}

/// "polygon_offset_factor 2, polygon_offset_units 0.5"
std::string further_keys_text(const analysis::FurtherBias& further)
{
    std::string text;
    for (const auto& [key, value] : further.keys) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", scene::key_leaf(key),
                            scene::to_toml(value));
    }
    return text;
}

PresetRow further_row(const analysis::PresetResult& result)
{
    const analysis::FurtherBias& further = *result.further;
    return {preset_label(result),       further_keys_text(further),      digits(further.constant),
            digits(further.constant_m), digits(further.constant_texels), digits(further.constant_r),
            digits(further.slope_m)};
}

std::string gap_text(const std::optional<analysis::Quantiles>& gaps)
{
    return gaps ? fmt::format("{:.3g} to {:.3g}", gaps->median, gaps->p95)
                : std::string{nothing_there};
}

PresetRow error_row(const analysis::PresetResult& result)
{
    const analysis::Metrics& metrics = result.metrics;
    return {preset_label(result),
            grouped(metrics.false_shadow),
            percent(metrics.false_shadow_rate),
            grouped(metrics.false_lit),
            percent(metrics.false_lit_rate),
            percent(metrics.error_rate),
            grouped_amount(metrics.amounts.shadow),
            grouped_amount(metrics.amounts.light),
            gap_text(result.peter_panning.metres)};
}

} // namespace

std::string presets_table(std::span<const scene::Preset> presets)
{
    std::string text;
    for (const scene::Preset& preset : presets) {
        if (!text.empty()) {
            text += '\n';
        }
        text += preset_text(preset);
    }
    return text;
}

std::string preset_comparison_table(const analysis::PresetComparison& comparison)
{
    std::vector<PresetRow> biases{
        {"", "map", "filter", "constant", "[m]", "[texels]", "[r]", "slope", "normal [texels]"}};
    std::vector<PresetRow> further{
        {"", "further bias", "constant", "[m]", "[texels]", "[r]", "slope [m]"}};
    std::vector<PresetRow> errors{{"", "false shadow", "of lit", "false lit", "of blocked", "both",
                                   "dark [px]", "light [px]", "gap [m]"}};
    const auto add = [&](const analysis::PresetResult& result) {
        biases.push_back(bias_row(result));
        errors.push_back(error_row(result));
        if (result.further) {
            further.push_back(further_row(result));
        }
    };
    add(comparison.job);
    std::ranges::for_each(comparison.results, add);
    std::string text =
        fmt::format("{}, {} light\n", comparison.scene, scene::light_type_name(comparison.light));
    if (const auto& receiver = comparison.job.receiver) {
        text += fmt::format("biases at the median receiver, {} m from the light; r is the format's "
                            "smallest step\n",
                            digits(receiver->light_distance_m));
    }
    text += aligned_rows(biases) + aligned_rows(further) + aligned_rows(errors);
    for (const analysis::SkippedPreset& one : comparison.skipped) {
        text += fmt::format("{}left out: {}: {}\n", &one == comparison.skipped.data() ? "\n" : "",
                            one.preset->name, one.why);
    }
    return text;
}

namespace {

store::Json layer_object(const scene::Layer& layer)
{
    store::Json json = store::Json::object();
    for (const scene::Setting& setting : layer) {
        json[setting.spec->name] = store::Json::parse(scene::to_toml(setting.value));
    }
    return json;
}

store::Json light_array(const scene::Preset& preset)
{
    store::Json json = store::Json::array();
    for (const scene::LightType light : preset.lights) {
        json.push_back(scene::light_type_name(light));
    }
    return json;
}

store::Json further_bias_object(const std::optional<analysis::FurtherBias>& further)
{
    if (!further) {
        return nullptr;
    }
    store::Json keys = store::Json::object();
    for (const auto& [key, value] : further->keys) {
        keys[key] = store::Json::parse(scene::to_toml(value));
    }
    return {{"keys", std::move(keys)},           {"constant", further->constant},
            {"constant_m", further->constant_m}, {"constant_texels", further->constant_texels},
            {"constant_r", further->constant_r}, {"slope_m", further->slope_m}};
}

store::Json map_object(const scene::Job& job)
{
    const bool has_filter = scene::has_filters(job);
    return {{"method", job.method.name},
            {"resolution", job.shadow_map.resolution_texels},
            {"layout", scene::map_layout_name(scene::map_layout(job))},
            {"depth_format", scene::depth_format_name(job.shadow_map.depth_format)},
            {"filter", has_filter ? store::Json(scene::filter_name(job.lookup.filter))
                                  : store::Json(nullptr)},
            {"outside", scene::outside_name(job.lookup.outside)}};
}

store::Json bias_object(const std::optional<analysis::ReceiverBias>& receiver)
{
    if (!receiver) {
        return nullptr;
    }
    return {{"light_distance_m", receiver->light_distance_m},
            {"texel_m", receiver->texel_m},
            {"constant", receiver->bias.constant},
            {"constant_m", receiver->bias.constant_m},
            {"constant_texels", receiver->bias.constant_texels},
            {"constant_r", receiver->constant_r},
            {"slope", receiver->slope},
            {"slope_m", receiver->bias.slope_m},
            {"normal_texels", receiver->normal_texels},
            {"normal_offset_m", receiver->bias.normal_offset_m}};
}

store::Json gap_object(const std::optional<analysis::Quantiles>& gaps)
{
    if (!gaps) {
        return {{"median", nullptr}, {"p95", nullptr}, {"max", nullptr}};
    }
    return {{"median", gaps->median}, {"p95", gaps->p95}, {"max", gaps->max}};
}

void add_outcome(store::Json& json, const analysis::PresetResult& result)
{
    const analysis::Metrics& metrics = result.metrics;
    json["map"] = map_object(result.job);
    json["map_bytes"] = result.map_bytes;
    json["bias"] = bias_object(result.receiver);
    json["further_bias"] = further_bias_object(result.further);
    json["lit"] = metrics.pixels.of(scene::PixelClass::lit);
    json["blocked"] = metrics.pixels.of(scene::PixelClass::blocked);
    json["mismatch"] = metrics.pixels.of(scene::ClassReason::mismatch);
    json["false_shadow"] = metrics.false_shadow;
    json["false_lit"] = metrics.false_lit;
    json["false_shadow_rate"] = store::number_or_null(metrics.false_shadow_rate);
    json["false_lit_rate"] = store::number_or_null(metrics.false_lit_rate);
    json["error_rate"] = store::number_or_null(metrics.error_rate);
    json["shadow_amount"] = metrics.amounts.shadow;
    json["light_amount"] = metrics.amounts.light;
    json["mean_abs_error"] = store::number_or_null(metrics.mean_abs_error);
    json["peter_panning_gap_m"] = gap_object(result.peter_panning.metres);
}

store::Json result_object(const analysis::PresetResult& result)
{
    store::Json json{{"name", result.preset->name},
                     {"kind", scene::preset_kind_name(result.preset->kind)},
                     {"own_bias", result.preset->own_bias}};
    add_outcome(json, result);
    return json;
}

} // namespace

std::string presets_json(std::span<const scene::Preset> presets)
{
    store::Json json = store::Json::array();
    for (const scene::Preset& preset : presets) {
        json.push_back({{"name", preset.name},
                        {"kind", scene::preset_kind_name(preset.kind)},
                        {"sentence", preset.sentence},
                        {"source", preset.source},
                        {"lights", light_array(preset)},
                        {"own_bias", preset.own_bias},
                        {"cannot", preset.cannot},
                        {"keys", layer_object(preset.job)},
                        {"own_scene", layer_object(preset.own_scene)}});
    }
    return json.dump(2) + "\n";
}

std::string preset_comparison_json(const analysis::PresetComparison& comparison)
{
    store::Json job = store::Json::object();
    add_outcome(job, comparison.job);
    store::Json results = store::Json::array();
    for (const analysis::PresetResult& result : comparison.results) {
        results.push_back(result_object(result));
    }
    store::Json skipped = store::Json::array();
    for (const analysis::SkippedPreset& one : comparison.skipped) {
        skipped.push_back({{"name", one.preset->name}, {"why", one.why}});
    }
    const store::Json json{{"schema", 1},
                           {"scene", comparison.scene},
                           {"light", scene::light_type_name(comparison.light)},
                           {"job", std::move(job)},
                           {"presets", std::move(results)},
                           {"skipped", std::move(skipped)}};
    return store::json_text(json, 2) + "\n";
}

} // namespace gnomon::reports
