#include "reports/depth/depth_csv.hpp"

#include <fmt/format.h>

#include <iterator>

namespace gnomon::reports {

std::string depth_csv(const analysis::DepthStudy& study,
                      std::span<const analysis::DepthErrorRow> rows)
{
    const std::string tolerance =
        study.tolerance ? fmt::format(",{}", study.tolerance->tolerance_m) : std::string{};
    std::string text = "zeta_m,depth,envelope_m,formula_code,formula_error_m,code,stored_zeta_m,"
                       "error_m,transform_error_m,model_m,class";
    text += study.tolerance ? ",tolerance_m\n" : "\n";
    auto out = std::back_inserter(text);
    for (const analysis::DepthErrorRow& row : rows) {
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
