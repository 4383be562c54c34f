#include "reports/depth/depth_report.hpp"

#include "reports/depth/depth_parts.hpp"
#include "scene/settings/job.hpp"
#include "store/json_values.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace gnomon::reports {

namespace {

using analysis::DepthErrorRow;
using analysis::DepthStudy;
using analysis::DepthTheory;
using analysis::MeasuredDepthError;

store::Json theory_json(const DepthTheory& theory)
{
    return {{"max_error_m", theory.max_error_m},
            {"envelope_at_near_m", theory.envelope_at_near_m},
            {"envelope_at_far_m", theory.envelope_at_far_m},
            {"step_at_near_m", theory.step_at_near_m},
            {"step_at_far_m", theory.step_at_far_m},
            {"coarsest_at_m", theory.coarsest_at_m},
            {"largest_envelope_m", theory.largest_envelope_m},
            {"largest_step_m", theory.largest_step_m},
            {"codes_per_metre_at_near", 1 / theory.step_at_near_m},
            {"codes_per_metre_at_far", 1 / theory.step_at_far_m},
            {"half_of_codes_within_m", theory.half_of_codes_within_m},
            {"code_share_within_1m", theory.code_share_within_1m},
            {"distance_of_1m_step_m", store::number_or_null(theory.distance_of_1m_step_m)},
            {"float_limit_m", theory.float_limit_m},
            {"transform_error_at_far_m",
             {{"view_then_projection", store::number_or_null(theory.separate_transform_at_far_m)},
              {"premultiplied", store::number_or_null(theory.premultiplied_transform_at_far_m)}}}};
}

store::Json measured_json(const MeasuredDepthError& measured)
{
    return {{"samples", measured.rows.size()},
            {"missing", measured.missing},
            {"max_error_m", measured.max_error_m},
            {"max_error_at_m", measured.max_error_light_distance_m},
            {"rms_error_m", measured.rms_error_m},
            {"mean_error_m", measured.mean_error_m},
            {"standard_deviation_m", measured.standard_deviation_m},
            {"max_excess_m", measured.max_excess_m},
            {"max_transform_error_m", measured.max_transform_error_m},
            {"max_share_of_model", measured.max_share_of_model},
            {"certificate", certificate_json(measured.certificate)}};
}

store::Json sample_json(const DepthErrorRow& row, bool is_measured)
{
    store::Json json{{"zeta_m", row.light_distance_m},
                     {"depth", row.depth},
                     {"envelope_m", row.envelope_m},
                     {"formula_code", row.formula_code},
                     {"formula_error_m", row.formula_error_m}};
    if (is_measured) {
        json["code"] = row.code;
        json["stored_zeta_m"] = row.stored_light_distance_m;
        json["error_m"] = row.error_m;
        json["transform_error_m"] = row.transform_error_m;
        json["model_m"] = row.model_m;
        json["class"] = analysis::texel_class_name(row.texel_class);
    }
    return json;
}

/// The depth range to report; for distance maps, that of the camera that draws them.
scene::DepthRange drawn_range(const analysis::DepthMapping& mapping)
{
    return mapping.stores_gl_depth()
               ? mapping.range()
               : scene::DepthRange{scene::Projection::perspective, mapping.near_m(),
                                   mapping.far_m(), false, scene::ClipRange::minus_one_to_one};
}

std::string_view clip_range_name(scene::ClipRange range)
{
    return range == scene::ClipRange::zero_to_one ? "zero_to_one" : "minus_one_to_one";
}

std::string_view spacing_name(scene::Spacing spacing)
{
    constexpr std::array<std::string_view, 3> names{"even", "floating", "packed"};
    return names.at(static_cast<std::size_t>(spacing));
}

} // namespace

store::Json frustum_json(const scene::DepthRange& range)
{
    return {{"projection", scene::projection_name(range.projection)},
            {"near_m", range.near_m},
            {"far_m", range.far_m},
            {"reversed", range.reversed},
            {"clip_range", clip_range_name(range.clip_range)}};
}

store::Json certificate_json(const analysis::DepthCertificate& certificate)
{
    store::Json json{{"texels", certificate.texels}};
    for (std::size_t i = 0; i < analysis::texel_class_count; ++i) {
        json[std::string{analysis::texel_class_name(static_cast<analysis::TexelClass>(i))}] =
            certificate.counts.at(i);
    }
    json["largest_residual_codes"] = certificate.largest_residual_codes;
    json["rms_residual_codes"] = certificate.rms_residual_codes;
    json["largest_share_of_bound"] = certificate.largest_share_of_bound;
    json["histogram"] = store::Json::array();
    for (std::size_t bin = 0; bin < certificate.histogram.size(); ++bin) {
        const double end = analysis::histogram_end_codes(bin);
        json["histogram"].push_back(
            {{"up_to_codes", std::isfinite(end) ? store::Json(end) : store::Json()},
             {"texels", certificate.histogram.at(bin)}});
    }
    return json;
}

store::Json depth_summary_json(const DepthStudy& study)
{
    store::Json json{{"format", study.format},
                     {"bits", study.coding.bits()},
                     {"float", study.coding.is_float()},
                     {"spacing", spacing_name(study.coding.spacing())},
                     {"content", scene::map_content_name(study.mapping.content())},
                     {"frustum", frustum_json(drawn_range(study.mapping))},
                     {"theory", theory_json(study.theory)}};
    json["measured"] = study.measured ? measured_json(*study.measured) : store::Json();
    json["not_measured_because"] =
        study.measured ? store::Json() : store::Json(study.not_measured_because);
    json["tolerance"] = study.tolerance
                            ? store::Json{{"tolerance_m", study.tolerance->tolerance_m},
                                          {"exceeded_from_m",
                                           store::number_or_null(study.tolerance->exceeded_from_m)}}
                            : store::Json();
    json["tilt_deg"] = study.tilt_rad * 180 / std::numbers::pi;
    json["offset_m"] = study.offset_m;
    return json;
}

std::string depth_json(const DepthStudy& study, std::span<const DepthErrorRow> rows,
                       const std::string& gl_renderer, const std::string& gl_version)
{
    store::Json json{{"schema", 1}};
    json.update(depth_summary_json(study));
    json["environment"] = {{"gl_renderer", gl_renderer}, {"gl_version", gl_version}};
    json["samples"] = store::Json::array();
    for (const DepthErrorRow& row : rows) {
        json["samples"].push_back(sample_json(row, study.measured.has_value()));
    }
    return json.dump(2) + "\n";
}

std::string depth_comparison_json(std::span<const DepthStudy> studies,
                                  const std::string& gl_renderer, const std::string& gl_version)
{
    store::Json json{{"schema", 1},
                     {"environment", {{"gl_renderer", gl_renderer}, {"gl_version", gl_version}}}};
    json["formats"] = store::Json::array();
    for (const DepthStudy& study : studies) {
        json["formats"].push_back(depth_summary_json(study));
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
