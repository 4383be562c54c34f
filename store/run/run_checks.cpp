#include "store/run/run_checks.hpp"

#include "scene/text.hpp"

#include <fmt/format.h>

namespace gnomon::store {

namespace {

constexpr std::string_view report_advice =
    "report it with the job and the output of `gnomon doctor`";

} // namespace

RunChecks read_run_checks(const sqlite::Database& database)
{
    RunChecks checks;
    sqlite::Statement configurations{database,
                                     "SELECT count(*) FROM configurations WHERE status = 'done'"
                                     " AND \"unmatched_kinds.mismatch\" > 0"
                                     " AND number IN (SELECT configuration FROM part)"};
    checks.mismatched = static_cast<std::uint64_t>(configurations.first().value_or(0));
    sqlite::Statement curves{database,
                             "SELECT count(*), count(t.curve), sum(t.verdicts), sum(t.differences)"
                             " FROM curves v LEFT JOIN verifications t ON t.curve = v.number"
                             " WHERE v.bias_source = 'curve' AND v.number IN"
                             " (SELECT c.curve FROM part p CROSS JOIN configurations c"
                             " ON c.number = p.configuration WHERE c.status = 'done')"};
    if (curves.step()) {
        int column = 0;
        for (std::uint64_t* const count :
             {&checks.curves, &checks.verified, &checks.verdicts, &checks.differences}) {
            *count = static_cast<std::uint64_t>(curves.integer(column++));
        }
    }
    return checks;
}

std::string verification_text(const RunChecks& checks)
{
    if (checks.curves == 0) {
        return "nothing: without a bias curve every bias is GL's own run";
    }
    return fmt::format("{} of {}, {} of {} differ", scene::grouped(checks.verified),
                       scene::counted(checks.curves, "bias curve"),
                       scene::grouped(checks.differences),
                       scene::counted(checks.verdicts, "verdict"));
}

std::string failed_checks_text(const RunChecks& checks)
{
    if (checks.mismatched > 0) {
        return fmt::format("{} with pixels that mismatch: GL's triangle is neither a first hit nor "
                           "explained by snapping or depth resolution; {}",
                           scene::counted(checks.mismatched, "configuration"), report_advice);
    }
    if (checks.differences > 0) {
        return fmt::format("{} of GL's reruns are not those of the bias curve: its numbers do not "
                           "hold for this driver; {}",
                           scene::counted(checks.differences, "verdict"), report_advice);
    }
    return {};
}

} // namespace gnomon::store
