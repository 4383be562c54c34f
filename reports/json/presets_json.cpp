#include "reports/json/presets_json.hpp"

#include "scene/job/keys/key_table.hpp"
#include "store/json_values.hpp"

#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::reports {

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
