#include "store/run/run_status.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/shell_text.hpp"

#include <fmt/format.h>

namespace gnomon::store {

RunStatus read_run_status(const std::filesystem::path& folder, std::uint64_t most)
{
    const RunStore store{folder, RunStore::Access::read_older};
    RunStatus status{folder, store.description(), 0, 0, 0, store.retriable(), store.checks(), {},
                     {},     store.schema()};
    if (status.description.size == 0) {
        throw scene::InputError(
            fmt::format("{}: no configuration is planned in it: run `gnomon sweep`",
                        scene::one_line(folder.string())));
    }
    const PlanOutcome outcome = store.outcome();
    status.done = outcome.done;
    status.failed = outcome.failed;
    // A merged run may lack parts that were not given to the merge.
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

} // namespace gnomon::store
