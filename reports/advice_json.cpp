#include "reports/advice_json.hpp"

#include "analysis/advice/remedies.hpp"
#include "reports/remedy_words.hpp"

#include <optional>
#include <utility>

namespace gnomon::reports {

namespace {

Json vector_json(const scene::Vec3d& vector)
{
    return Json::array({vector.x, vector.y, vector.z});
}

Json vector_or_null(const std::optional<scene::Vec3d>& vector)
{
    return vector ? vector_json(*vector) : Json(nullptr);
}

/// What a change leaves, in the job's own view.
Json left_json(const analysis::Outcome& outcome, const std::optional<double>& error_rate)
{
    return {
        {"false_shadow", outcome.errors.false_shadow}, {"false_lit", outcome.errors.false_lit},
        {"error_rate", number_or_null(error_rate)},    {"shadow_amount", outcome.amounts.shadow},
        {"light_amount", outcome.amounts.light},       {"softening", outcome.softening}};
}

Json advice_json(const analysis::Remedy& remedy)
{
    Json json{{"keys", remedy.keys}};
    json.update(left_json(remedy.outcome, remedy.error_rate));
    return json;
}

Json views_of(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    Json json = Json::array();
    for (std::size_t i = 0; i < remedy.views.size(); ++i) {
        Json view{{"name", comparison.advice_views.views.at(i).name}};
        view.update(outcome_json(remedy.views[i]));
        json.push_back(std::move(view));
    }
    return json;
}

Json remedy_json(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    Json json{{"toml", remedy_toml(remedy)}, {"keys", remedy.keys}};
    json.update(left_json(remedy.outcome, remedy.error_rate));
    json["map_bytes"] = remedy.map_bytes;
    json["taps"] = remedy.taps;
    json["measured_by"] =
        analysis::measured_by_names.at(static_cast<std::size_t>(remedy.measured_by));
    json["bias"] = remedy.bias ? Json(remedy.bias->depth) : Json(nullptr);
    json["bias_m"] = remedy.bias ? Json(remedy.bias->metres) : Json(nullptr);
    json["bias_texels"] = remedy.bias ? Json(remedy.bias->texels) : Json(nullptr);
    const bool has_step = remedy.step.after_m > 0;
    json["depth_step_m"] = has_step ? Json(remedy.step.after_m) : Json(nullptr);
    json["depth_step_before_m"] = has_step ? Json(remedy.step.before_m) : Json(nullptr);
    json["views"] = remedy.views.empty() ? Json(nullptr) : views_of(comparison, remedy);
    json["pooled"] =
        remedy.views.empty() ? Json(nullptr) : outcome_json(analysis::pooled(remedy.views));
    json["worst_view"] =
        remedy.views.empty()
            ? Json(nullptr)
            : Json(comparison.advice_views.views.at(analysis::worst_view(remedy.views)).name);
    return json;
}

} // namespace

Json outcome_json(const analysis::ViewOutcome& outcome)
{
    const analysis::Metrics& metrics = outcome.metrics;
    return {{"bias", outcome.constant},
            {"scored", metrics.pixels.scored()},
            {"false_shadow", metrics.false_shadow},
            {"false_lit", metrics.false_lit},
            {"false_shadow_rate", number_or_null(metrics.false_shadow_rate)},
            {"false_lit_rate", number_or_null(metrics.false_lit_rate)},
            {"error_rate", number_or_null(metrics.error_rate)},
            {"shadow_amount", metrics.amounts.shadow},
            {"light_amount", metrics.amounts.light},
            {"shadow_softening", outcome.shadow_softening},
            {"light_softening", outcome.light_softening},
            {"error_amount_rate", number_or_null(outcome.error_rate())}};
}

Json view_json(const std::string& name, const scene::CameraSettings& camera,
               const scene::LightSettings& light)
{
    return {{"name", name},
            {"eye", vector_json(camera.eye)},
            {"target", vector_json(camera.target)},
            {"up", vector_json(camera.up)},
            {"light",
             {{"type", scene::light_type_name(light.type)},
              {"direction", vector_or_null(light.direction)},
              {"position", vector_or_null(light.position)},
              {"target", vector_or_null(light.target)}}}};
}

void add_advice(Json& json, const analysis::Comparison& comparison)
{
    json["remedies"] = Json::array();
    for (const analysis::Remedy& remedy : analysis::ranked_remedies(comparison)) {
        json["remedies"].push_back(remedy_json(comparison, remedy));
    }
    json["advice"] = comparison.advice.empty() ? Json(nullptr) : Json::array();
    for (const analysis::Remedy& remedy : comparison.advice) {
        json["advice"].push_back(advice_json(remedy));
    }
    const analysis::AdviceViews& views = comparison.advice_views;
    json["views"] = views.views.empty() ? Json(nullptr) : Json::array();
    json["views_passed_over"] = views.views.empty() ? Json(nullptr) : Json(views.passed_over);
    for (const analysis::AdviceViews::View& view : views.views) {
        Json entry = view_json(view.name, view.camera, view.light);
        entry["now"] = outcome_json(view.now);
        json["views"].push_back(std::move(entry));
    }
}

} // namespace gnomon::reports
