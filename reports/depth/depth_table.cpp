#include "reports/depth/depth_report.hpp"

#include "reports/depth/depth_parts.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

namespace gnomon::reports {

std::string range_text(const scene::DepthRange& range)
{
    return fmt::format("{}, near {} m, far {} m, clip {}{}",
                       scene::projection_name(range.projection), range.near_m, range.far_m,
                       range.clip_range == scene::ClipRange::zero_to_one ? "[0, 1]" : "[-1, 1]",
                       range.reversed ? ", reversed" : "");
}

std::string mapping_text(const analysis::DepthMapping& mapping)
{
    return mapping.stores_gl_depth() ? range_text(mapping.range())
                                     : fmt::format("{} over far, near {} m, far {} m",
                                                   scene::map_content_name(mapping.content()),
                                                   mapping.near_m(), mapping.far_m());
}

std::string_view distance_symbol(const analysis::DepthMapping& mapping)
{
    return mapping.measure() == scene::Measure::ray ? "r" : "z";
}

std::string metres(double length_m)
{
    return fmt::format("{:.4g} m", length_m);
}

namespace {

using analysis::DepthErrorRow;
using analysis::DepthMapping;
using analysis::DepthStudy;
using analysis::DepthTheory;
using analysis::MeasuredDepthError;

std::string format_text(const DepthStudy& study)
{
    constexpr std::array<std::string_view, 3> spacing_text{"", " float", " packed"};
    return fmt::format("{}, {} bits{}", study.format, study.coding.bits(),
                       spacing_text.at(static_cast<std::size_t>(study.coding.spacing())));
}

std::string view_text(const DepthStudy& study)
{
    const std::string place =
        study.offset_m == 0
            ? std::string{"at the origin"}
            : fmt::format("{:g} m from the origin on each axis", std::abs(study.offset_m));
    return fmt::format("camera {}, planes tilted by {:g} deg", place,
                       study.tilt_rad * 180 / std::numbers::pi);
}

std::string theory_text(const DepthStudy& study)
{
    const DepthTheory& t = study.theory;
    std::string text = "theory\n";
    text += setting_line("largest error", metres(t.max_error_m));
    const auto near_and_largest = [&](double at_near_m, double largest_m) {
        return study.mapping.is_perspective() || study.coding.spacing() != scene::Spacing::even
                   ? fmt::format("{} at near, at most {} at {}", metres(at_near_m),
                                 metres(largest_m), metres(t.coarsest_at_m))
                   : fmt::format("{} everywhere", metres(largest_m));
    };
    text += setting_line("envelope", near_and_largest(t.envelope_at_near_m, t.largest_envelope_m));
    text += setting_line("code step", near_and_largest(t.step_at_near_m, t.largest_step_m));
    text += setting_line("codes", fmt::format("half of them within {}, {} within 1 m",
                                              metres(t.half_of_codes_within_m),
                                              percent(t.code_share_within_1m)));
    if (t.distance_of_1m_step_m) {
        text += setting_line("1 m steps", fmt::format("at {}", metres(*t.distance_of_1m_step_m)));
    }
    if (t.separate_transform_at_far_m && t.premultiplied_transform_at_far_m) {
        text += setting_line("transform", fmt::format("at most {} at far, by one matrix {}",
                                                      metres(*t.separate_transform_at_far_m),
                                                      metres(*t.premultiplied_transform_at_far_m)));
    }
    return text;
}

/// Where a constant tolerance covers the storage error.
std::string tolerance_text(const DepthStudy& study)
{
    const auto& [tolerance_m, exceeded_from_m] = *study.tolerance;
    const DepthMapping& mapping = study.mapping;
    std::string covered = "more than the envelope at every distance";
    if (exceeded_from_m) {
        covered = *exceeded_from_m > mapping.near_m()
                      ? fmt::format("less than the envelope from {} on", metres(*exceeded_from_m))
                      : std::string{"less than the envelope from near on"};
    }
    return setting_line("tolerance", fmt::format("{}: {}", metres(tolerance_m), covered)) +
           setting_line("", fmt::format("in depth units {:.3g} at near, {:.3g} at far",
                                        tolerance_m / mapping.slope_m(mapping.near_m()),
                                        tolerance_m / mapping.slope_m(mapping.far_m())));
}

/// "99.7 % nearest code, 0.3 % within the format, …"; empty classes are left out.
std::string classes_text(const analysis::DepthCertificate& certificate)
{
    constexpr std::array<std::string_view, analysis::texel_class_count> words{
        "nearest code", "within the format", "within the driver model", "OUTSIDE the driver model"};
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (const std::size_t count = certificate.counts.at(i); count > 0) {
            const double share =
                static_cast<double>(count) / static_cast<double>(certificate.texels);
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", percent(share), words.at(i));
        }
    }
    return text;
}

std::string measured_text(const MeasuredDepthError& m)
{
    std::string text =
        fmt::format("\nmeasured on {} planes{}\n", grouped(m.rows.size()),
                    m.missing == 0 ? ""
                                   : fmt::format(", {} left out, clipped or moved by float32",
                                                 grouped(m.missing)));
    text += setting_line("largest error", fmt::format("{} at {}", metres(m.max_error_m),
                                                      metres(m.max_error_light_distance_m)));
    text +=
        setting_line("rms error", fmt::format("{}, standard deviation {}", metres(m.rms_error_m),
                                              metres(m.standard_deviation_m)));
    text += setting_line("excess",
                         m.max_excess_m > 0
                             ? fmt::format("up to {} above the envelope", metres(m.max_excess_m))
                             : std::string{"none: no sample leaves the envelope"});
    text += setting_line(
        "transform", fmt::format("up to {}, part of the errors", metres(m.max_transform_error_m)));
    text += setting_line(
        "driver model", fmt::format("errors reach {} of its bound", percent(m.max_share_of_model)));
    text += setting_line("texels", classes_text(m.certificate));
    return text;
}

/// Most rows shown, evenly spread, including the first and the last.
constexpr std::size_t shown_rows = 9;

std::string code_text(const analysis::DepthCoding& coding, std::uint32_t code)
{
    return coding.spacing() == scene::Spacing::even
               ? grouped(code)
               : fmt::format("{:#0{}x}", code, 2 + coding.bits() / 4);
}

std::string rows_text(const DepthStudy& study, std::span<const DepthErrorRow> rows)
{
    const bool is_measured = study.measured.has_value();
    const std::string metres_of = fmt::format("{} [m]", distance_symbol(study.mapping));
    const bool has_depths = study.mapping.stores_gl_depth();
    std::string text = fmt::format("\n{:>10}{:>13}{:>16}{:>15}{:>14}", metres_of,
                                   has_depths ? "exact depth" : "over far", "formula's code",
                                   "error [m]", "envelope [m]");
    text += is_measured
                ? fmt::format("{:>16}{:>16}{:>13}\n", "GL's code", "GL's " + metres_of, "error [m]")
                : std::string{"\n"};
    const std::size_t count = std::min(shown_rows, rows.size());
    for (std::size_t i = 0; i < count; ++i) {
        const DepthErrorRow& row = rows[count == 1 ? 0 : i * (rows.size() - 1) / (count - 1)];
        text += fmt::format("{:>10.5g}{:>13.8f}{:>16}{:>15.3g}{:>14.3g}", row.light_distance_m,
                            row.depth, code_text(study.coding, row.formula_code),
                            row.formula_error_m, row.envelope_m);
        text += is_measured
                    ? fmt::format("{:>16}{:>16.8g}{:>13.3g}\n", code_text(study.coding, row.code),
                                  row.stored_light_distance_m, row.error_m)
                    : std::string{"\n"};
    }
    return text;
}

} // namespace

std::string depth_table(const DepthStudy& study, std::span<const DepthErrorRow> rows,
                        const std::string& gl_renderer)
{
    std::string text = setting_line("frustum", mapping_text(study.mapping));
    text += setting_line("format", format_text(study));
    text += setting_line("planes", view_text(study));
    text += study.measured ? setting_line("GL", gl_renderer)
                           : setting_line("not measured", study.not_measured_because);
    text += "\n";
    text += theory_text(study);
    if (study.tolerance) {
        text += tolerance_text(study);
    }
    if (study.measured) {
        text += measured_text(*study.measured);
    }
    text += rows_text(study, rows);
    return text;
}

std::string depth_comparison_table(std::span<const DepthStudy> studies,
                                   const std::string& gl_renderer)
{
    const analysis::DepthMapping& mapping = studies.front().mapping;
    scene::DepthRange range = mapping.range();
    range.reversed = false;
    const bool has_depths = mapping.stores_gl_depth();
    std::string text =
        setting_line("frustum", has_depths ? range_text(range) : mapping_text(mapping));
    if (!gl_renderer.empty()) {
        text += setting_line("GL", gl_renderer);
    }
    text +=
        fmt::format("\n{:<16}{:>13}{:>13}{:>14}{:>14}{:>13}{:>13}  {}\n", "", "step at near",
                    "largest step", "largest error", "GL's largest", "GL's rms", "excess", "[m]");
    for (const DepthStudy& study : studies) {
        text += fmt::format("{:<16}{:>13.3g}{:>13.3g}{:>14.4g}",
                            study.format + (study.mapping.range().reversed ? " reversed" : ""),
                            study.theory.step_at_near_m, study.theory.largest_step_m,
                            study.theory.max_error_m);
        if (study.measured) {
            const auto& m = *study.measured;
            text += fmt::format("{:>14.4g}{:>13.3g}{:>13}\n", m.max_error_m, m.rms_error_m,
                                m.max_excess_m > 0 ? fmt::format("{:.3g}", m.max_excess_m) : "-");
        } else {
            text += fmt::format("{:>14}{:>13}{:>13}\n", "-", "-", "-");
        }
    }
    return text;
}

std::string depth_csv(const DepthStudy& study, std::span<const DepthErrorRow> rows)
{
    const std::string tolerance =
        study.tolerance ? fmt::format(",{}", study.tolerance->tolerance_m) : std::string{};
    std::string text = "zeta_m,depth,envelope_m,formula_code,formula_error_m,code,stored_zeta_m,"
                       "error_m,transform_error_m,model_m,class";
    text += study.tolerance ? ",tolerance_m\n" : "\n";
    auto out = std::back_inserter(text);
    for (const DepthErrorRow& row : rows) {
        fmt::format_to(out, "{},{},{},{},{},", row.light_distance_m, row.depth, row.envelope_m,
                       row.formula_code, row.formula_error_m);
        if (study.measured) {
            fmt::format_to(out, "{},{},{},{},{},{}", row.code, row.stored_light_distance_m,
                           row.error_m, row.transform_error_m, row.model_m,
                           analysis::texel_class_name(row.texel_class));
        } else {
            text += ",,,,,";
        }
        text += tolerance + "\n";
    }
    return text;
}

} // namespace gnomon::reports
