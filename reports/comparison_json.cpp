#include "reports/comparison_json.hpp"

#include "analysis/answers/finished_curve.hpp"
#include "reports/diagnosis_json.hpp"
#include "reports/evaluation_json.hpp"
#include "reports/exact_inputs.hpp"
#include "reports/json_values.hpp"
#include "reports/metric_json.hpp"
#include "reports/scene_notes_json.hpp"
#include "scene/job/file.hpp"

#include <algorithm>
#include <optional>

namespace gnomon::reports {

namespace {

std::string text(const Json& json, int indent)
{
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json truth_signs(const scene::TruthSigns& signs)
{
    return {{"filtered", signs.filtered}, {"exact", signs.exact}};
}

Json float_audit(const std::vector<scene::FloatMethodErrors>& methods)
{
    Json json = Json::object();
    for (const scene::FloatMethodErrors& method : methods) {
        json[method.name] = {{"false_blocked", method.false_blocked},
                             {"false_lit", method.false_lit}};
    }
    return json.empty() ? Json(nullptr) : json;
}

Json environment(const analysis::Environment& environment)
{
    return {{"gl_renderer", environment.gl_renderer},
            {"gl_version", environment.gl_version},
            {"embree", environment.embree},
            {"gnomon", environment.gnomon}};
}

Json seconds(const analysis::StageSeconds& seconds)
{
    return {{"scene", seconds.scene},         {"bvh", seconds.bvh},
            {"receivers", seconds.receivers}, {"shadow_map", seconds.shadow_map},
            {"lookup", seconds.lookup},       {"truth", seconds.truth},
            {"analysis", seconds.analysis}};
}

/// The keys' values come in TOML's syntax, which for numbers, booleans, plain strings and arrays is
/// JSON's too; anything else stays the text that it is.
Json job_object(const analysis::Comparison& comparison)
{
    const auto& evaluation = comparison.evaluation;
    Json json = Json::object();
    for (const auto& [key, value] : scene::resolved_keys(comparison.job)) {
        if (evaluation &&
            std::ranges::find(evaluation->given_keys, key) == evaluation->given_keys.end()) {
            continue;
        }
        Json parsed = Json::parse(value, nullptr, false);
        json[key] = parsed.is_discarded() ? Json(value) : parsed;
    }
    return json;
}

Json scene_object(const analysis::SceneSummary& scene)
{
    return {{"name", scene.name},
            {"triangles", scene.triangles},
            {"objects", scene.objects},
            {"dropped_triangles", scene.dropped_triangles},
            {"ignored_primitives", scene.ignored_primitives},
            {"hash", scene.hash},
            {"notes", scene_notes_json(scene.notes)}};
}

Json frustum_object(const scene::LightFrustum& frustum, int resolution_texels)
{
    const bool is_perspective = frustum.projection == scene::Projection::perspective;
    return {{"projection", is_perspective ? "perspective" : "orthographic"},
            {"near_m", frustum.near_m},
            {"far_m", frustum.far_m},
            {"reversed", frustum.reversed},
            {"texel_m", frustum.texel_width_m(1.0, resolution_texels)}};
}

Json exact_inputs_object(const analysis::Comparison& comparison)
{
    Json json = Json::object();
    for (const ExactInput& input : exact_inputs(comparison)) {
        json[input.name] = input.values.size() == 1 ? Json(input.values[0]) : Json(input.values);
    }
    return json;
}

} // namespace

std::string job_json(const analysis::Comparison& comparison)
{
    return text(job_object(comparison), -1);
}

std::string comparison_json(const analysis::Comparison& comparison)
{
    Json json{{"schema", 2}};
    add_metrics(json, analysis::configuration_metrics(), analysis::result_of(comparison));
    add_diagnosis(json, comparison);
    json["environment"] = environment(comparison.environment);
    json["seconds"] = seconds(comparison.seconds);
    json["scene"] = scene_object(comparison.scene);
    json["job"] = job_object(comparison);
    json["frustum"] =
        frustum_object(comparison.view.frustum, comparison.job.shadow_map.resolution_texels);
    json["truth_method"] = comparison.truth_method;
    json["truth_signs"] = truth_signs(comparison.truth.signs);
    json["float_audit"] = float_audit(comparison.float_audit);
    json["subpixel_bits"] = comparison.subpixel_bits;
    json["exact_inputs"] = exact_inputs_object(comparison);
    if (comparison.evaluation) {
        add_evaluation(json, comparison, *comparison.evaluation);
    }
    return text(json, 2) + "\n";
}

} // namespace gnomon::reports
