#include "reports/json/comparison_json.hpp"

#include "analysis/comparison/comparison.hpp"
#include "analysis/results/results.hpp"
#include "methods/job_method.hpp"
#include "reports/json/json_parts.hpp"
#include "reports/text/error_text.hpp"
#include "scene/error.hpp"
#include "store/exr/header.hpp"
#include "store/json_values.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace gnomon::reports {

namespace {

std::optional<std::size_t> index_in_array(std::string_view part)
{
    if (part == "lo" || part == "hi") {
        return part == "lo" ? 0 : 1;
    }
    std::size_t index = 0;
    const char* const end = part.data() + part.size();
    const auto [stop, error] = std::from_chars(part.data(), end, index);
    return error == std::errc{} && stop == end ? std::optional{index} : std::nullopt;
}

} // namespace

store::Json& member_at(store::Json& json, std::string_view name)
{
    store::Json* found = &json;
    while (!name.empty()) {
        const std::string_view part = name.substr(0, name.find('.'));
        name.remove_prefix(part.size() == name.size() ? part.size() : part.size() + 1);
        const auto index = index_in_array(part);
        found = index ? &(*found)[*index] : &(*found)[std::string{part}];
    }
    return *found;
}

store::Json value_json(const analysis::MetricValue& value)
{
    return std::visit(
        [](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) {
                return store::Json(nullptr);
            } else {
                return store::Json(held);
            }
        },
        value);
}

namespace {

store::Json scene_notes_json(std::span<const scene::SceneNote> notes)
{
    store::Json json = store::Json::array();
    for (const scene::SceneNote& note : notes) {
        json.push_back({{"kind", note.kind}, {"count", note.count}, {"text", note.text}});
    }
    return json;
}

store::Json truth_signs(const scene::TruthSigns& signs)
{
    return {{"filtered", signs.filtered}, {"exact", signs.exact}};
}

store::Json float_audit(const std::vector<scene::FloatMethodErrors>& methods)
{
    store::Json json = store::Json::object();
    for (const scene::FloatMethodErrors& method : methods) {
        json[method.name] = {{"false_blocked", method.false_blocked},
                             {"false_lit", method.false_lit}};
    }
    return json.empty() ? store::Json(nullptr) : json;
}

store::Json environment(const analysis::Environment& environment)
{
    return {{"gl_renderer", environment.gl_renderer},
            {"gl_version", environment.gl_version},
            {"embree", environment.embree},
            {"gnomon", environment.gnomon}};
}

store::Json seconds(const analysis::StageSeconds& seconds)
{
    return {{"scene", seconds.scene},         {"bvh", seconds.bvh},
            {"receivers", seconds.receivers}, {"shadow_map", seconds.shadow_map},
            {"lookup", seconds.lookup},       {"truth", seconds.truth},
            {"analysis", seconds.analysis}};
}

store::Json scene_object(const analysis::SceneSummary& scene)
{
    return {{"name", scene.name},
            {"triangles", scene.triangles},
            {"objects", scene.objects},
            {"dropped_triangles", scene.dropped_triangles},
            {"ignored_primitives", scene.ignored_primitives},
            {"hash", scene.hash},
            {"notes", scene_notes_json(scene.notes)}};
}

/// Null without a map.
store::Json frustum_value(const scene::Job& job, const scene::View& view)
{
    if (view.maps.empty() || !methods::traits(job).has_map) {
        return nullptr;
    }
    const int resolution_texels = job.shadow_map.resolution_texels;
    const scene::LightFrustum& frustum = view.first_map();
    const bool is_perspective = frustum.projection == scene::Projection::perspective;
    store::Json json{{"projection", is_perspective ? "perspective" : "orthographic"},
                     {"near_m", frustum.near_m},
                     {"far_m", frustum.far_m},
                     {"reversed", frustum.reversed},
                     {"texel_m", frustum.texel_width_m(1.0, resolution_texels)}};
    if (const auto& content = traits_of(frustum.content); !content.is_gl_depth()) {
        json["content"] = content.name;
    }
    return json;
}

store::Json exact_inputs_object(const analysis::Comparison& comparison)
{
    store::Json json = store::Json::object();
    for (const store::ExactInput& input : store::exact_inputs(comparison)) {
        json[input.name] =
            input.values.size() == 1 ? store::Json(input.values[0]) : store::Json(input.values);
    }
    return json;
}

store::Json quantiles_of(const analysis::Quantiles& values)
{
    return {{"median", values.median}, {"p95", values.p95}, {"max", values.max}};
}

store::Json lengths_object(const analysis::OffsetLengths& lengths)
{
    return {{"depth", quantiles_of(lengths.depth)},
            {"m", quantiles_of(lengths.metres)},
            {"texels", quantiles_of(lengths.texels)}};
}

store::Json polygon_offset_object(const analysis::DrawnOffset& drawn)
{
    return {{"factor", drawn.offset.factor},
            {"units", drawn.offset.units},
            {"clamp", drawn.offset.clamp},
            {"r", quantiles_of(drawn.r)},
            {"of_factor", lengths_object(drawn.of_factor)},
            {"of_units", lengths_object(drawn.of_units)},
            {"whole", lengths_object(drawn.whole)}};
}

/// The members of one light's comparison.
void add_comparison(store::Json& json, const analysis::Comparison& comparison)
{
    add_metrics(json, analysis::configuration_metrics(), analysis::result_of(comparison));
    add_diagnosis(json, comparison);
    json["environment"] = environment(comparison.environment);
    json["seconds"] = seconds(comparison.seconds);
    json["scene"] = scene_object(comparison.scene);
    json["job"] = store::job_object(comparison);
    json["frustum"] = frustum_value(comparison.job, comparison.view);
    if (comparison.drawn_offset) {
        json["polygon_offset"] = polygon_offset_object(*comparison.drawn_offset);
    }
    json["truth_method"] = comparison.truth_method;
    json["truth_signs"] = truth_signs(comparison.truth.signs);
    json["float_audit"] = float_audit(comparison.float_audit);
    json["subpixel_bits"] = comparison.subpixel_bits;
    json["exact_inputs"] = exact_inputs_object(comparison);
    if (comparison.evaluation) {
        add_evaluation(json, comparison, *comparison.evaluation);
    }
}

} // namespace

std::string comparison_json(const analysis::Comparison& comparison)
{
    store::Json json{{"schema", 2}};
    add_comparison(json, comparison);
    return store::json_text(json, 2) + "\n";
}

namespace {

/// Targets that cannot have the light or the method are left out.
store::Json all_settings(const analysis::Comparison& comparison,
                         std::span<const SettingsTarget> targets)
{
    store::Json all = store::Json::array();
    for (const SettingsTarget& target : targets) {
        try {
            all.push_back(settings_object(translate(target, comparison, true)));
        } catch (const scene::InputError&) {
            continue;
        }
    }
    return all;
}

} // namespace

std::string kept_json(const analysis::Comparison& comparison,
                      std::span<const SettingsTarget> targets)
{
    store::Json json{{"schema", 2}};
    add_comparison(json, comparison);
    if (comparison.diagnosis) {
        json["headline"] = error_headline(comparison);
    }
    if (comparison.environment.is_of_gl() && !comparison.evaluation) {
        json["engine_settings"] = all_settings(comparison, targets);
    }
    return store::json_text(json, 2) + "\n";
}

std::string comparison_json(std::span<const analysis::Comparison> lights)
{
    store::Json json{{"schema", 2}};
    add_metrics(json, analysis::configuration_metrics(),
                analysis::total_of(analysis::results_of(lights)));
    json["environment"] = environment(lights.front().environment);
    json["scene"] = scene_object(lights.front().scene);
    json["lights"] = store::Json::array();
    for (const analysis::Comparison& comparison : lights) {
        store::Json of_light{{"name", comparison.light}};
        add_comparison(of_light, comparison);
        json["lights"].push_back(std::move(of_light));
    }
    return store::json_text(json, 2) + "\n";
}

} // namespace gnomon::reports
