#include "reports/depth/depth_csv.hpp"

#include <fmt/format.h>

#include <iterator>

namespace gnomon::reports {

std::string depth_csv(std::span<const analysis::DepthErrorRow> rows, bool is_measured)
{
    std::string text = "zeta_m,depth,envelope_m,formula_code,formula_error_m,code,stored_zeta_m,"
                       "error_m,transform_error_m,model_m,class\n";
    auto out = std::back_inserter(text);
    for (const analysis::DepthErrorRow& row : rows) {
        fmt::format_to(out, "{},{},{},{},{},", row.zeta_m, row.depth, row.envelope_m,
                       row.formula_code, row.formula_error_m);
        if (is_measured) {
            fmt::format_to(out, "{},{},{},{},{},{}\n", row.code, row.stored_zeta_m, row.error_m,
                           row.transform_error_m, row.model_m,
                           analysis::texel_class_name(row.texel_class));
        } else {
            text += ",,,,,\n";
        }
    }
    return text;
}

} // namespace gnomon::reports
