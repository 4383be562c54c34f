#include "reports/tables/run_status_text.hpp"

#include "reports/text/text.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

/// The run's part of a divided sweep.
std::string part_text(const store::Shard& shard)
{
    return shard.count == 1 ? "" : fmt::format(", shard {} of {}", shard.index, shard.count);
}

std::string row_line(const store::RunRow& row)
{
    std::string line = fmt::format("  {}", row.ordinal);
    if (!row.case_name.empty()) {
        line += fmt::format("  case {}", row.case_name);
    }
    for (const auto& [key, value] : row.axes) {
        line += fmt::format("  {} = {}", key, value);
    }
    if (!row.message.empty()) {
        line += fmt::format(": {}", row.message);
    }
    return scene::one_line(line) + '\n';
}

std::string row_lines(std::string_view title, const std::vector<store::RunRow>& rows,
                      std::uint64_t count)
{
    if (rows.empty()) {
        return {};
    }
    std::string text = fmt::format("\n{}\n", title);
    for (const store::RunRow& row : rows) {
        text += row_line(row);
    }
    if (count > rows.size()) {
        text += fmt::format("  and {} more\n", grouped(count - rows.size()));
    }
    return text;
}

store::Json rows_json(const std::vector<store::RunRow>& rows)
{
    store::Json json = store::Json::array();
    for (const store::RunRow& row : rows) {
        store::Json axes = store::Json::object();
        for (const auto& [key, value] : row.axes) {
            axes[key] = value;
        }
        json.push_back({{"ordinal", row.ordinal},
                        {"id", row.id},
                        {"case", row.case_name},
                        {"message", row.message},
                        {"axes", std::move(axes)}});
    }
    return json;
}

store::Json verification_json(const store::RunChecks& checks)
{
    return {{"curves", checks.curves},
            {"verified", checks.verified},
            {"verdicts", checks.verdicts},
            {"differences", checks.differences}};
}

} // namespace

std::string useless_retry_text(std::uint64_t count)
{
    return fmt::format("{} cannot pass as {} given: change the keys that the message names, in the "
                       "job or its axes, and run the sweep again",
                       counted(count, "failed configuration"), count == 1 ? "it is" : "they are");
}

std::string run_status_text(const store::RunStatus& status)
{
    const std::uint64_t total = status.done + status.failed + status.missing;
    std::string text = fmt::format("{}: {} of {} done, {} failed, {} missing{}\n",
                                   scene::one_line(status.folder.string()), grouped(status.done),
                                   counted(total, "configuration"), grouped(status.failed),
                                   grouped(status.missing), part_text(status.description.shard));
    if (status.checks.verified > 0) {
        text += fmt::format("  verified: {}\n", store::verification_text(status.checks));
    }
    if (!status.checks.are_passed()) {
        text += fmt::format("  {}\n", store::failed_checks_text(status.checks));
    }
    if (const std::string schema = store::schema_text(status.schema); !schema.empty()) {
        text += fmt::format("  {}\n", schema);
    }
    text += row_lines("failed", status.failed_rows, status.failed);
    text += row_lines("missing", status.missing_rows, status.missing);
    const std::string command = store::resuming_command(status);
    if (status.failed > status.retriable) {
        text += fmt::format("\n{}\n", useless_retry_text(status.failed - status.retriable));
    }
    if ((status.missing > 0 || status.retriable > 0) && !command.empty()) {
        text += fmt::format("\nresume with\n  {}\n", scene::one_line(command));
    }
    return text;
}

std::string run_status_json(const store::RunStatus& status)
{
    const store::RunDescription& description = status.description;
    const store::Shard& shard = description.shard;
    const store::Json json{{"schema", 1},
                           {"complete", status.is_complete()},
                           {"done", status.done},
                           {"failed", status.failed},
                           {"missing", status.missing},
                           {"retriable", status.retriable},
                           {"shard", fmt::format("{}/{}", shard.index, shard.count)},
                           {"sweep_size", description.size},
                           {"run_schema", status.schema.version},
                           {"lacks", status.schema.lacks},
                           {"axes", description.axes},
                           {"environment",
                            {{"gl_renderer", description.environment.gl_renderer},
                             {"gl_version", description.environment.gl_version},
                             {"embree", description.environment.embree},
                             {"gnomon", description.environment.gnomon}}},
                           {"mismatched", status.checks.mismatched},
                           {"verification", verification_json(status.checks)},
                           {"resume", store::resuming_command(status)},
                           {"failed_configurations", rows_json(status.failed_rows)},
                           {"missing_configurations", rows_json(status.missing_rows)}};
    return json.dump(2, ' ', false, store::Json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::reports
