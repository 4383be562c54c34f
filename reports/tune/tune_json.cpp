#include "reports/tune/tune_report.hpp"

#include "reports/json/json_parts.hpp"
#include "reports/text/findings.hpp"
#include "reports/text/text.hpp"
#include "reports/tune/tuned_setting.hpp"
#include "scene/vec.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace gnomon::reports {

namespace {

using analysis::TunedSetting;
using analysis::TuneLimits;
using analysis::TuneResult;
using analysis::ViewOutcome;

store::Json plane_json(const std::optional<double>& plane_m)
{
    return plane_m ? store::Json(*plane_m) : store::Json("auto");
}

store::Json value_json(const scene::JobValue& value)
{
    return std::visit(
        [](const auto& one) {
            if constexpr (std::is_same_v<std::decay_t<decltype(one)>, scene::Vec3d>) {
                return store::Json{one.x, one.y, one.z};
            } else {
                return store::Json(one);
            }
        },
        value);
}

/// Adds the method and its keys, and sets shared keys that it lacks to null.
void add_method(store::Json& json, const TunedSetting& setting)
{
    constexpr std::array<std::string_view, 10> shared{
        "shadow_map.resolution", "shadow_map.depth_format", "shadow_map.fit",
        "shadow_map.near",       "shadow_map.far",          "shadow_map.cull",
        "lookup.filter",         "bias.constant",           "bias.slope",
        "bias.normal_texels"};
    for (const std::string_view key : shared) {
        if (!has_key(setting, key)) {
            json[std::string{key}] = nullptr;
        }
    }
    json["method.name"] = setting.method->name;
    for (const auto& [key, value] : method_keys(setting)) {
        json[key] = value_json(value);
    }
}

store::Json setting_json(const TunedSetting& setting)
{
    const analysis::BiasInterval& run = setting.bias.run;
    store::Json json{
        {"shadow_map.resolution", setting.map.resolution_texels},
        {"shadow_map.depth_format", scene::depth_format_name(setting.map.depth_format)},
        {"shadow_map.fit", scene::fit_name(setting.map.frustum.fit)},
        {"shadow_map.near", plane_json(setting.map.frustum.near_m)},
        {"shadow_map.far", plane_json(setting.map.frustum.far_m)},
        {"shadow_map.cull", scene::cull_name(setting.map.cull)},
        {"lookup.filter", setting.has_filter ? store::Json(scene::filter_name(setting.filter))
                                             : store::Json(nullptr)},
        {"bias.constant", setting.bias.constant()},
        {"bias.slope", setting.slope},
        {"bias.normal_texels", setting.normal_texels},
        {"map_bytes", setting.cost.map_bytes},
        {"taps", setting.cost.taps}};
    if (const analysis::RoundedBias& rounded = setting.bias.rounded; !rounded.unit->is_depth()) {
        json[std::string{rounded.unit->key}] = rounded.value;
    }
    if (setting.sets_half_extent) {
        json["shadow_map.half_extent"] = setting.map.frustum.half_extent_m;
    }
    if (has_cascades(setting)) {
        const scene::CascadeSettings& cascades = setting.map.cascades;
        json["shadow_map.cascades"] = cascades.count;
        json["shadow_map.split"] = scene::cascade_split_name(cascades.split);
        json["shadow_map.cascade_fit"] = scene::cascade_fit_name(cascades.fit);
        if (cascades.split == scene::CascadeSplit::practical) {
            json["shadow_map.split_lambda"] = cascades.split_lambda;
        }
    }
    if (setting.method) {
        add_method(json, setting);
    }
    json.update(outcome_json(setting.pooled()));
    json["best_interval"] = {run.lo,
                             std::isfinite(run.hi) ? store::Json(run.hi) : store::Json(nullptr)};
    json["views"] = setting.bias.outcomes.size();
    json["meets_limits"] = setting.meets_limits();
    return json;
}

store::Json views_json(const TuneResult& result, const TuneLimits& limits)
{
    store::Json json = store::Json::array();
    for (std::size_t i = 0; i < result.views.size(); ++i) {
        const scene::Job& job = result.views[i].job;
        store::Json view = view_json(result.views[i].name, *job.camera, *job.light);
        view["measured"] = outcome_json(result.measured_views[i]);
        view["meets_limits"] = meets(result.measured_views[i], limits);
        json.push_back(std::move(view));
    }
    return json;
}

store::Json states_json(const TuneResult& result)
{
    store::Json json = store::Json::object();
    for (const ApiState& state :
         api_states(result.best(), map_offset(result), other_biases(result.measured.job))) {
        json[state.api] = state.lines;
    }
    return json;
}

store::Json measured_json(std::span<const ViewOutcome> measured,
                          const std::vector<analysis::AdviceView>& views, const TuneLimits& limits)
{
    store::Json json = store::Json::array();
    for (std::size_t i = 0; i < measured.size(); ++i) {
        json.push_back({{"name", views[i].name},
                        {"measured", outcome_json(measured[i])},
                        {"meets_limits", meets(measured[i], limits)}});
    }
    return json;
}

store::Json method_json(const analysis::TunedMethod& method, const TuneResult& result,
                        const std::string& light, const TuneLimits& limits)
{
    store::Json refused = store::Json::array();
    for (const analysis::RefusedSetting& setting : method.refused) {
        refused.push_back({{"keys", setting.keys}, {"reason", setting.reason}});
    }
    const scene::Fit own_fit = result.views.front().job.shadow_map.frustum.fit;
    return {{"name", method.name},
            {"meets_limits", method.best.meets_limits()},
            {"recommended", setting_json(method.best)},
            {"toml", tune_toml(method.best, own_fit, light)},
            {"views", measured_json(method.measured, result.views, limits)},
            {"pooled", outcome_json(analysis::pooled(method.measured))},
            {"worst_view", result.views[analysis::worst_view(method.measured)].name},
            {"settings", method.settings},
            {"refused", std::move(refused)}};
}

void add_methods(store::Json& json, const TunedLight& tuned, const TuneLimits& limits)
{
    const analysis::MethodRanking& ranking = *tuned.result.methods;
    json["limits"]["max_bytes"] = ranking.max_bytes;
    json["most_settings"] = ranking.most_settings;
    json["methods"] = store::Json::array();
    for (const analysis::TunedMethod& method : ranking.ranked) {
        json["methods"].push_back(method_json(method, tuned.result, tuned.light, limits));
    }
    json["methods_passed_over"] = methods_passed_over_json(ranking.passed_over);
}

store::Json limits_json(const TuneLimits& limits, bool is_relative)
{
    return {{"relative", is_relative},
            {"max_shadow_amount_rate", limits.max_shadow_amount_rate},
            {"max_light_amount_rate", limits.max_light_amount_rate},
            {"max_false_shadow_rate", limits.max_false_shadow_rate},
            {"max_false_lit_rate", limits.max_false_lit_rate},
            {"max_resolution", limits.max_resolution_texels}};
}

/// The result if nothing can be recommended.
store::Json nothing_json(const TuneResult& result)
{
    return {{"meets_limits", false},
            {"limits", limits_json(result.limits, result.relative_limits > 0)},
            {"recommended", nullptr},
            {"toml", ""},
            {"why", {result.nothing}},
            {"considered", store::Json::array()}};
}

store::Json errors_json(const analysis::Metrics& metrics)
{
    return {{"false_shadow", metrics.false_shadow},
            {"false_lit", metrics.false_lit},
            {"false_shadow_rate", store::number_or_null(metrics.false_shadow_rate)},
            {"false_lit_rate", store::number_or_null(metrics.false_lit_rate)},
            {"error_rate", store::number_or_null(metrics.error_rate)},
            {"shadow_amount", metrics.amounts.shadow},
            {"light_amount", metrics.amounts.light}};
}

store::Json light_json(const TunedLight& tuned)
{
    const TuneResult& result = tuned.result;
    const TuneLimits& limits = result.limits;
    if (!result.nothing.empty()) {
        return nothing_json(result);
    }
    store::Json json{{"meets_limits", result.meets_limits()},
                     {"limits", limits_json(limits, result.relative_limits > 0)},
                     {"time_s", result.time_s},
                     {"is_cut_short", result.is_cut_short},
                     {"recommended", nullptr},
                     {"toml", ""},
                     {"measured", errors_json(result.measured.metrics)},
                     {"views", views_json(result, limits)},
                     {"views_passed_over", result.passed_over},
                     {"pooled", outcome_json(analysis::pooled(result.measured_views))},
                     {"worst_view", result.views[analysis::worst_view(result.measured_views)].name},
                     {"why", errors_as_text(result.measured)}};
    if (result.recommends()) {
        json["recommended"] = setting_json(result.best());
        json["toml"] = best_toml(tuned);
        json["states"] = states_json(result);
    } else {
        json["least_wrong"] = setting_json(result.best());
        json["why"].insert(json["why"].begin(),
                           fmt::format("The least wrong setting still lights {} of what is "
                                       "blocked; nothing is recommended.",
                                       percent(result.most_lit())));
    }
    json["considered"] = store::Json::array();
    for (const TunedSetting& setting : result.considered) {
        json["considered"].push_back(setting_json(setting));
    }
    if (result.methods) {
        add_methods(json, tuned, limits);
    } else if (result.recommends()) {
        json["least_wrong"] = setting_json(result.considered[result.least_wrong]);
    }
    return json;
}

bool all_meet(std::span<const TunedLight> lights)
{
    return std::ranges::all_of(lights,
                               [](const TunedLight& tuned) { return tuned.result.meets_limits(); });
}

} // namespace

std::string tune_json(std::span<const TunedLight> lights)
{
    store::Json json{{"schema", 1}};
    if (lights.front().light.empty()) {
        json.update(light_json(lights.front()));
        return json.dump(2) + "\n";
    }
    json["meets_limits"] = all_meet(lights);
    json["lights"] = store::Json::array();
    for (const TunedLight& tuned : lights) {
        store::Json of_light{{"name", tuned.light}};
        of_light.update(light_json(tuned));
        json["lights"].push_back(std::move(of_light));
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
