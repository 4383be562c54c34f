#include "reports/json/json_parts.hpp"

#include "reports/json/comparison_json.hpp"
#include "store/json_values.hpp"

#include <string>

namespace gnomon::reports {

namespace {

using scene::ClassReason;

store::Json quantiles_or_null(const std::optional<analysis::Quantiles>& lengths)
{
    return lengths ? store::Json{{"count", lengths->count},
                                 {"median", lengths->median},
                                 {"p95", lengths->p95},
                                 {"max", lengths->max}}
                   : store::Json(nullptr);
}

/// Sets causes and labels that were not counted to null.
void add_bias_causes(store::Json& json, const analysis::BiasCauses& found)
{
    json["causes"] = {{"bias", found.bias()},
                      {"precision", nullptr},
                      {"filter", nullptr},
                      {"resolution", nullptr},
                      {"coverage", nullptr}};
    // Not only biases overshadow: so does missing coverage.
    json["labels"] = {{"acne", nullptr},  {"peter_panning", found.peter_panning},
                      {"bleed", nullptr}, {"leak", nullptr},
                      {"edge", nullptr},  {"overshadow", nullptr}};
}

store::Json cannot_know(const std::vector<analysis::UnansweredQuestion>& all)
{
    store::Json json = store::Json::array();
    for (const analysis::UnansweredQuestion& one : all) {
        json.push_back({{"what", one.what}, {"needs", one.needs}});
    }
    return json;
}

store::Json import_check_json(const analysis::ImportCheck& check)
{
    const analysis::ImportDistances& distances = check.distances;
    store::Json json{
        {"points", distances.points},
        {"distance_m",
         {{"median", distances.median_m}, {"p99", distances.p99_m}, {"max", distances.max_m}}},
        {"tolerance_m", distances.tolerance_m},
        {"agreement", store::number_or_null(check.agreement)}};
    json["mistake"] = check.mistake.empty() ? store::Json(nullptr) : store::Json(check.mistake);
    json["sentence"] = check.sentence.empty() ? store::Json(nullptr) : store::Json(check.sentence);
    json["warning"] = check.warning.empty() ? store::Json(nullptr) : store::Json(check.warning);
    return json;
}

store::Json evaluate_object(const analysis::Comparison& comparison,
                            const analysis::Evaluation& evaluation)
{
    const auto& found = evaluation.bias_causes;
    const auto& set_aside = evaluation.import_check.silhouette_pixels;
    store::Json json{
        {"case", evaluation.case_name},
        {"renderer", comparison.environment.gl_renderer},
        {"level", evaluation.level},
        {"positions", set_aside ? "camera" : "image"},
        {"silhouette_pixels", set_aside ? store::Json(*set_aside) : store::Json(nullptr)},
        {"cannot_know", cannot_know(evaluation.cannot_know)},
        {"import_check", import_check_json(evaluation.import_check)},
        {"false_lit_gap_m", quantiles_or_null(evaluation.false_lit_gap_m)},
        {"contradicted_pixels", evaluation.contradicted_pixels
                                    ? store::Json(*evaluation.contradicted_pixels)
                                    : store::Json(nullptr)},
        {"errors_of_unknown_cause", found ? store::Json(found->unknown) : store::Json(nullptr)},
        {"overshadow_by_bias", found ? store::Json(found->overshadow) : store::Json(nullptr)},
        {"grown_pixels", evaluation.grown_pixels},
        {"largest_growth_m", evaluation.largest_growth_m},
        {"off_surface_pixels", evaluation.off_surface_pixels}};
    if (evaluation.frame_s) {
        json["frame_seconds"] = *evaluation.frame_s;
    }
    return json;
}

} // namespace

void add_evaluation(store::Json& json, const analysis::Comparison& comparison,
                    const analysis::Evaluation& evaluation)
{
    json["indeterminate_kinds"]["rounding"] = comparison.metrics.pixels.of(ClassReason::rounding);
    if (evaluation.level == 0) {
        json["pixels"]["attached"] = nullptr;
    }
    if (evaluation.bias_causes) {
        add_bias_causes(json, *evaluation.bias_causes);
    }
    if (!evaluation.has_map) {
        json["frustum"] = nullptr;
    }
    json["subpixel_bits"] = nullptr;
    json["evaluate"] = evaluate_object(comparison, evaluation);
}

std::string check_json(const analysis::ImportCheck& check)
{
    const store::Json json{{"schema", 1}, {"import_check", import_check_json(check)}};
    return json.dump(2, ' ', false, store::Json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::reports
