#include "store/run/run_commands.hpp"

#include "scene/job/keys/key_table.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/run/run_columns.hpp"
#include "store/shell_text.hpp"

#include <fmt/format.h>

namespace gnomon::store {

std::string run_command(const RunDescription& description)
{
    const Shard shard = description.shard;
    return shard.count == 1
               ? description.command
               : fmt::format("{} --shard {}/{}", description.command, shard.index, shard.count);
}

std::string compare_command(const RunDescription& description, const ResultRow& row)
{
    std::vector<std::pair<std::string, std::string>> axes;
    for (const std::string& axis : description.axes) {
        axes.emplace_back(axis, row.text(axis));
    }
    return compare_command(description, row.text("case"), axes);
}

std::string compare_command(const RunDescription& description, const std::string& case_name,
                            const std::vector<std::pair<std::string, std::string>>& axes)
{
    if (description.compare_command.empty()) {
        return {};
    }
    if (description.compare_command.starts_with("gnomon evaluate ")) {
        return description.compare_command; // it names its one case already
    }
    std::vector<std::string> words;
    if (!case_name.empty()) {
        words.insert(words.end(), {"--case", case_name});
    }
    for (const auto& [axis, value] : axes) {
        if (axis == scene::light_distinction) {
            words.push_back(light_option(value));
        } else {
            words.insert(words.end(), {"--set", fmt::format("{}={}", axis, value)});
        }
    }
    words.insert(words.end(), {"--out", "DIR"});
    return fmt::format("{} {}", description.compare_command, shell_text(words));
}

std::string light_option(const std::string& light)
{
    return "--light=" + light;
}

std::vector<std::pair<std::string, std::string>> job_settings(const ResultRow& row)
{
    std::vector<std::pair<std::string, std::string>> settings;
    for (const JobColumn& column : job_columns()) {
        if (std::string value = row.text(column.name); !value.empty()) {
            settings.emplace_back(column.name, std::move(value));
        }
    }
    for (const auto& [name, value] : row.cells()) {
        if (scene::is_engine_key(name)) {
            settings.emplace_back(name, row.text(name));
        }
    }
    return settings;
}

} // namespace gnomon::store
