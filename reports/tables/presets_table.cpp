#include "reports/tables/presets_table.hpp"

#include "reports/tables/aligned_rows.hpp"
#include "reports/text/text.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
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

/// Of a map with several layers how many there are.
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

} // namespace gnomon::reports
