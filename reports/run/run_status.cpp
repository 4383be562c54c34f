#include "reports/run/run_status.hpp"

#include "reports/json_values.hpp"
#include "reports/shell_text.hpp"
#include "reports/text.hpp"
#include "scene/error.hpp"
#include "scene/job/toml.hpp"

#include <fmt/format.h>

#include <string_view>

namespace gnomon::reports {

namespace {

/// Which part of a divided sweep the run is.
std::string part_text(const Shard& shard)
{
    return shard.count == 1 ? "" : fmt::format(", shard {} of {}", shard.index, shard.count);
}

std::string row_line(const RunRow& row)
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

std::string row_lines(std::string_view title, const std::vector<RunRow>& rows, std::uint64_t count)
{
    if (rows.empty()) {
        return {};
    }
    std::string text = fmt::format("\n{}\n", title);
    for (const RunRow& row : rows) {
        text += row_line(row);
    }
    if (count > rows.size()) {
        text += fmt::format("  and {} more\n", grouped(count - rows.size()));
    }
    return text;
}

Json rows_json(const std::vector<RunRow>& rows)
{
    Json json = Json::array();
    for (const RunRow& row : rows) {
        Json axes = Json::object();
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

Json verification_json(const RunChecks& checks)
{
    return {{"curves", checks.curves},
            {"verified", checks.verified},
            {"verdicts", checks.verdicts},
            {"differences", checks.differences}};
}

} // namespace

RunStatus read_run_status(const std::filesystem::path& folder, std::uint64_t most)
{
    const RunStore store{folder, RunStore::Access::read_older};
    RunStatus status{folder, store.description(), 0, 0, 0, store.retriable(), store.checks(), {},
                     {},     store.schema()};
    if (status.description.size == 0) {
        throw scene::InputError(fmt::format("{}: nothing was planned in it: run `gnomon sweep`",
                                            scene::one_line(folder.string())));
    }
    const PlanOutcome outcome = store.outcome();
    status.done = outcome.done;
    status.failed = outcome.failed;
    // A merged run may lack parts whose plan nobody gave.
    status.missing = status.description.shard.count == 1
                         ? status.description.size - outcome.done - outcome.failed
                         : outcome.planned;
    status.failed_rows = store.rows(RunState::failed, most);
    status.missing_rows = store.rows(RunState::planned, most);
    return status;
}

std::string resuming_command(const RunStatus& status)
{
    const RunDescription& description = status.description;
    if (description.command.empty() || status.schema.version != run_schema) {
        return {};
    }
    std::string command =
        fmt::format("{} --out {}", description.command, shell_text({status.folder.string()}));
    if (description.shard.count > 1) {
        command += fmt::format(" --shard {}/{}", description.shard.index, description.shard.count);
    }
    return status.retriable > 0 ? command + " --retry failed" : command;
}

std::string useless_retry_text(std::uint64_t count)
{
    return fmt::format("{} cannot pass as {} given: change the keys that the message names, in the "
                       "job or its axes, and run the sweep again",
                       counted(count, "failed configuration"), count == 1 ? "it is" : "they are");
}

std::string run_status_text(const RunStatus& status)
{
    const std::uint64_t total = status.done + status.failed + status.missing;
    std::string text = fmt::format("{}: {} of {} done, {} failed, {} missing{}\n",
                                   scene::one_line(status.folder.string()), grouped(status.done),
                                   counted(total, "configuration"), grouped(status.failed),
                                   grouped(status.missing), part_text(status.description.shard));
    if (status.checks.verified > 0) {
        text += fmt::format("  verified: {}\n", verification_text(status.checks));
    }
    if (!status.checks.are_passed()) {
        text += fmt::format("  {}\n", failed_checks_text(status.checks));
    }
    if (const std::string schema = schema_text(status.schema); !schema.empty()) {
        text += fmt::format("  {}\n", schema);
    }
    text += row_lines("failed", status.failed_rows, status.failed);
    text += row_lines("missing", status.missing_rows, status.missing);
    const std::string command = resuming_command(status);
    if (status.failed > status.retriable) {
        text += fmt::format("\n{}\n", useless_retry_text(status.failed - status.retriable));
    }
    if ((status.missing > 0 || status.retriable > 0) && !command.empty()) {
        text += fmt::format("\nresume with\n  {}\n", scene::one_line(command));
    }
    return text;
}

std::string run_status_json(const RunStatus& status)
{
    const RunDescription& description = status.description;
    const Shard& shard = description.shard;
    const Json json{{"schema", 1},
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
                    {"resume", resuming_command(status)},
                    {"failed_configurations", rows_json(status.failed_rows)},
                    {"missing_configurations", rows_json(status.missing_rows)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::reports
