#include "reports/tables/comparison_parts.hpp"

#include "reports/tables/comparison_table.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/text/description.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>

namespace gnomon::reports {

namespace {

std::string distance_text(const analysis::ImportDistances& distances)
{
    return fmt::format("median {:.2g} m, 99 % {:.2g} m, largest {:.2g} m; {:.2g} m tolerated",
                       distances.median_m, distances.p99_m, distances.max_m, distances.tolerance_m);
}

std::string warning_line(const analysis::ImportCheck& check)
{
    return check.warning.empty() ? "" : fmt::format("Warning: {}.\n", check.warning);
}

std::string bias_lines(const analysis::BiasCauses& found)
{
    std::string text = "\n";
    text += count_line("cause", "pixels", "", "");
    text += count_line("bias", grouped(found.bias()), "",
                       fmt::format("{} peter-panning, {} overshadow", grouped(found.peter_panning),
                                   grouped(found.overshadow)));
    return text + count_line("other causes", grouped(found.unknown), "", "not told apart");
}

/// The source of the receiver points P, and their distance from the mesh.
std::string position_line(const analysis::ImportCheck& check)
{
    if (!check.silhouette_pixels) {
        return setting_line("P off the mesh", distance_text(check.distances));
    }
    return setting_line("P",
                        fmt::format("of the camera's pixel centres, as the image has none; {} set "
                                    "aside, which a silhouette may cross",
                                    counted(*check.silhouette_pixels, "pixel")));
}

} // namespace

std::string evaluation_settings(const analysis::Comparison& comparison,
                                const analysis::Evaluation& evaluation)
{
    const Description words = describe(comparison);
    std::string text = setting_line("case", evaluation.case_name);
    text += setting_line("renderer", comparison.environment.gl_renderer);
    text += setting_line("mesh", comparison.scene.name);
    text += setting_line("", words.size);
    text += note_lines(comparison.scene.notes);
    text += setting_line("image", words.image);
    text += setting_line("light", words.light);
    text += setting_line("level", fmt::format("{}", evaluation.level));
    text += position_line(evaluation.import_check);
    if (evaluation.grown_pixels > 0) {
        text += setting_line("", fmt::format("rounding boxes grown for {} by up to {:.2g} m",
                                             counted(evaluation.grown_pixels, "pixel"),
                                             evaluation.largest_growth_m));
    }
    if (evaluation.off_surface_pixels > 0) {
        text +=
            setting_line("", fmt::format("{} not decided: farther than {:.2g} m from the surface",
                                         counted(evaluation.off_surface_pixels, "pixel"),
                                         evaluation.most_distance_m));
    }
    return text + setting_line("truth", fmt::format("{}, {}", comparison.truth_method,
                                                    comparison.environment.embree));
}

std::string evaluation_table(const analysis::Comparison& comparison,
                             const analysis::Evaluation& evaluation)
{
    std::string text;
    if (!comparison.diagnosis) {
        if (evaluation.bias_causes) {
            text += bias_lines(*evaluation.bias_causes);
        }
        text += object_table(evaluation.by_object);
    }
    if (const auto& gap = evaluation.false_lit_gap_m) {
        text += setting_line("", fmt::format("false light is {:.4g} m from its blocker at the "
                                             "median, {:.4g} m at 95 %, at most {:.4g} m",
                                             gap->median, gap->p95, gap->max));
    }
    if (const std::uint64_t pixels = evaluation.contradicted_pixels.value_or(0); pixels > 0) {
        text +=
            fmt::format("\nThe mask contradicts its own lookup at {}: z.light, z.map and the bias "
                        "give the other verdict.\nTheir causes and the bias curve are the "
                        "lookup's, not the mask's: look at "
                        "how mask and depths are written.\n",
                        counted(pixels, "scored pixel"));
    }
    if (!evaluation.import_check.warning.empty()) {
        text += fmt::format("\n{}", warning_line(evaluation.import_check));
    }
    text += evaluation.cannot_know.empty() ? "" : "\n";
    for (const analysis::UnansweredQuestion& one : evaluation.cannot_know) {
        text += fmt::format("cannot know {}; needs {}\n", one.what, one.needs);
    }
    return text;
}

std::string check_text(const analysis::ImportCheck& check)
{
    std::string text = position_line(check);
    if (check.agreement) {
        text +=
            setting_line("mask and truth",
                         fmt::format("agree by {:.3f} (1 all, 0 as by chance)", *check.agreement));
    }
    text += warning_line(check);
    return text + (check.sentence.empty() ? "The case can be scored.\n" : check.sentence + "\n");
}

} // namespace gnomon::reports
