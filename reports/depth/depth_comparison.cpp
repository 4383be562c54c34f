#include "reports/depth/depth_comparison.hpp"

#include "reports/depth/depth_json.hpp"
#include "reports/depth/depth_names.hpp"
#include "reports/tables/table_lines.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

namespace gnomon::reports {

using analysis::DepthStudy;

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
