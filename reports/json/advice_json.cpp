#include "reports/json/json_parts.hpp"

#include "analysis/advice/cures.hpp"
#include "analysis/advice/remedies.hpp"
#include "reports/text/remedy_text.hpp"
#include "store/json_values.hpp"

#include <optional>
#include <utility>

namespace gnomon::reports {

namespace {

store::Json vector_json(const scene::Vec3d& vector)
{
    return store::Json::array({vector.x, vector.y, vector.z});
}

store::Json vector_or_null(const std::optional<scene::Vec3d>& vector)
{
    return vector ? vector_json(*vector) : store::Json(nullptr);
}

/// The errors that a change leaves in the job's own view.
store::Json left_json(const analysis::Outcome& outcome, const std::optional<double>& error_rate)
{
    return {{"false_shadow", outcome.errors.false_shadow},
            {"false_lit", outcome.errors.false_lit},
            {"error_rate", store::number_or_null(error_rate)},
            {"shadow_amount", outcome.amounts.shadow},
            {"light_amount", outcome.amounts.light},
            {"softening", outcome.softening},
            {"error_amount", outcome.error_amount()}};
}

store::Json advice_json(const analysis::Remedy& remedy)
{
    store::Json json{{"keys", remedy.keys}};
    json.update(left_json(remedy.outcome, remedy.error_rate));
    return json;
}

/// The error measures that a remedy does not reduce.
store::Json not_lessened(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    const analysis::ErrorChanges changes = analysis::changes_of(comparison, remedy);
    store::Json names = store::Json::array();
    if (changes.wrong_pixels != analysis::Change::less) {
        names.push_back("wrong_pixels");
    }
    if (changes.amount != analysis::Change::less) {
        names.push_back("amount");
    }
    return names;
}

store::Json views_of(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    store::Json json = store::Json::array();
    for (std::size_t i = 0; i < remedy.views.size(); ++i) {
        store::Json view{{"name", comparison.advice_views.views.at(i).name}};
        view.update(outcome_json(remedy.views[i]));
        json.push_back(std::move(view));
    }
    return json;
}

store::Json remedy_json(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    store::Json json{{"toml", remedy_toml(remedy)}, {"keys", remedy.keys}};
    json.update(left_json(remedy.outcome, remedy.error_rate));
    json["not_lessened"] = not_lessened(comparison, remedy);
    json["map_bytes"] = remedy.cost.map_bytes;
    json["taps"] = remedy.cost.taps;
    json["measured_by"] =
        analysis::measured_by_names.at(static_cast<std::size_t>(remedy.measured_by));
    json["bias"] = remedy.bias ? store::Json(remedy.bias->depth) : store::Json(nullptr);
    json["bias_m"] = remedy.bias ? store::Json(remedy.bias->metres) : store::Json(nullptr);
    json["bias_texels"] = remedy.bias ? store::Json(remedy.bias->texels) : store::Json(nullptr);
    const bool has_step = remedy.step.after_m > 0;
    json["depth_step_m"] = has_step ? store::Json(remedy.step.after_m) : store::Json(nullptr);
    json["depth_step_before_m"] =
        has_step ? store::Json(remedy.step.before_m) : store::Json(nullptr);
    json["views"] = remedy.views.empty() ? store::Json(nullptr) : views_of(comparison, remedy);
    json["pooled"] =
        remedy.views.empty() ? store::Json(nullptr) : outcome_json(analysis::pooled(remedy.views));
    json["worst_view"] =
        remedy.views.empty()
            ? store::Json(nullptr)
            : store::Json(
                  comparison.advice_views.views.at(analysis::worst_view(remedy.views)).name);
    return json;
}

store::Json cure_json(const analysis::Cure& cure, double now)
{
    const analysis::Outcome& left = cure.outcome;
    return {
        {"cause", analysis::cause_names.at(static_cast<std::size_t>(cure.cause))},
        {"laid", cure.laid},
        {"keys", cure.keys},
        {"false_shadow", left.errors.false_shadow},
        {"false_lit", left.errors.false_lit},
        {"shadow_amount", left.amounts.shadow},
        {"light_amount", left.amounts.light},
        {"softening", left.softening},
        {"measured_by", analysis::measured_by_names.at(static_cast<std::size_t>(cure.measured_by))},
        {"cures", cure.cures(now)}};
}

} // namespace

store::Json outcome_json(const analysis::ViewOutcome& outcome)
{
    const analysis::Metrics& metrics = outcome.metrics;
    return {{"bias", outcome.constant},
            {"scored", metrics.pixels.scored()},
            {"false_shadow", metrics.false_shadow},
            {"false_lit", metrics.false_lit},
            {"false_shadow_rate", store::number_or_null(metrics.false_shadow_rate)},
            {"false_lit_rate", store::number_or_null(metrics.false_lit_rate)},
            {"error_rate", store::number_or_null(metrics.error_rate)},
            {"shadow_amount", metrics.amounts.shadow},
            {"light_amount", metrics.amounts.light},
            {"shadow_softening", outcome.shadow_softening},
            {"light_softening", outcome.light_softening},
            {"error_amount", outcome.error_amount()},
            {"error_amount_rate", store::number_or_null(outcome.error_rate())}};
}

store::Json view_json(const std::string& name, const scene::CameraSettings& camera,
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

store::Json methods_passed_over_json(const std::vector<analysis::PassedOverMethod>& passed_over)
{
    store::Json json = store::Json::array();
    for (const analysis::PassedOverMethod& method : passed_over) {
        json.push_back({{"name", method.method}, {"reason", method.reason}});
    }
    return json;
}

void add_advice(store::Json& json, const analysis::Comparison& comparison)
{
    json["remedies"] = store::Json::array();
    for (const analysis::Remedy& remedy : analysis::ranked_remedies(comparison)) {
        json["remedies"].push_back(remedy_json(comparison, remedy));
    }
    json["advice"] = comparison.advice.empty() ? store::Json(nullptr) : store::Json::array();
    for (const analysis::Remedy& remedy : comparison.advice) {
        json["advice"].push_back(advice_json(remedy));
    }
    const double now = analysis::error_amount(comparison);
    json["cures"] = store::Json::array();
    for (const analysis::Cure& cure : analysis::known_cures(comparison)) {
        json["cures"].push_back(cure_json(cure, now));
    }
    if (comparison.methods_passed_over) {
        json["methods_passed_over"] = methods_passed_over_json(*comparison.methods_passed_over);
    }
    const analysis::AdviceViews& views = comparison.advice_views;
    json["views"] = views.views.empty() ? store::Json(nullptr) : store::Json::array();
    json["views_passed_over"] =
        views.views.empty() ? store::Json(nullptr) : store::Json(views.passed_over);
    for (const analysis::AdviceViews::View& view : views.views) {
        store::Json entry = view_json(view.name, view.camera, view.light);
        entry["now"] = outcome_json(view.now);
        json["views"].push_back(std::move(entry));
    }
}

} // namespace gnomon::reports
