#include "reports/depth/depth_report.hpp"

#include "reports/depth/depth_parts.hpp"
#include "reports/tables/table_lines.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

namespace gnomon::reports {

using analysis::PlanAnswer;
using analysis::PlanTarget;

namespace {

std::string name_of(const PlanAnswer& answer)
{
    return answer.format.name + (answer.format.reversed ? " reversed" : "");
}

std::string length(const std::optional<double>& length_m)
{
    return length_m ? metres(*length_m) : "-";
}

} // namespace

std::string depth_plan_text(const PlanTarget& target, std::span<const PlanAnswer> answers)
{
    std::string text = setting_line(
        "target",
        fmt::format("error at most {} up to {}, {}{}", metres(target.max_error_m),
                    metres(target.far_m), scene::projection_name(target.projection),
                    target.near_m ? fmt::format(", near {}", metres(*target.near_m)) : ""));
    text += fmt::format("\n{:<16}{:>14}{:>18}{:>18}{}\n", "", "near from", "formula's limit",
                        "error at most", target.near_m ? "       holds up to" : "");
    for (const PlanAnswer& answer : answers) {
        const bool has_bound = answer.near_m || target.near_m;
        text += fmt::format("{:<16}{:>14}{:>18}{:>18}", name_of(answer), length(answer.near_m),
                            length(answer.formula_near_m),
                            has_bound ? metres(answer.error_at_far_m) : "-");
        text += target.near_m ? fmt::format("{:>18}\n", length(answer.reach_m)) : "\n";
    }
    text += "\nnear from: with it or a farther near plane GL keeps the target on flat planes, "
            "whichever of the\ntwo nearest codes it stores; formula's limit: no nearer plane can, "
            "even without other errors.\n";
    return text;
}

std::string depth_plan_json(const PlanTarget& target, std::span<const PlanAnswer> answers)
{
    store::Json json{{"schema", 1},
                     {"target",
                      {{"projection", scene::projection_name(target.projection)},
                       {"max_error_m", target.max_error_m},
                       {"far_m", target.far_m},
                       {"near_m", store::number_or_null(target.near_m)}}}};
    json["answers"] = store::Json::array();
    for (const PlanAnswer& answer : answers) {
        const bool has_bound = answer.near_m || target.near_m;
        json["answers"].push_back(
            {{"format", answer.format.name},
             {"reversed", answer.format.reversed},
             {"meets_target", answer.near_m.has_value()},
             {"near_m", store::number_or_null(answer.near_m)},
             {"formula_near_m", store::number_or_null(answer.formula_near_m)},
             {"error_bound_m", has_bound ? store::Json(answer.error_at_far_m) : store::Json()},
             {"reach_m", store::number_or_null(answer.reach_m)}});
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
