#include "cli/options/command_text.hpp"

#include "store/run/run_commands.hpp"
#include "store/shell_text.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace gnomon::cli {

std::string job_text(const JobOptions& options)
{
    if (options.job_path.empty()) {
        const std::string preset =
            options.preset.empty() ? "" : fmt::format("preset = \"{}\"\n", options.preset);
        return options.builtin.empty()
                   ? preset
                   : fmt::format("{}[scene]\nbuiltin = \"{}\"\n", preset, options.builtin);
    }
    if (!options.job_path.ends_with(".toml")) {
        return fmt::format("# {}\n", options.job_path);
    }
    std::ifstream file{options.job_path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, std::istreambuf_iterator<char>{}};
}

std::string command_text(std::string_view command, const JobOptions& options,
                         const std::vector<std::string>& axes)
{
    std::vector<std::string> words{"gnomon", std::string{command}};
    const auto add = [&](std::string_view option, const std::string& value) {
        if (!value.empty()) {
            words.emplace_back(option);
            words.push_back(value);
        }
    };
    if (!options.job_path.empty()) {
        words.push_back(options.job_path);
    }
    add("--builtin", options.builtin);
    add("--preset", options.preset);
    add("--case", options.case_name);
    if (options.light) {
        words.push_back(store::light_option(*options.light));
    }
    for (const std::string& setting : options.settings) {
        add("--set", setting);
    }
    for (const std::string& axis : axes) {
        add("--axis", axis);
    }
    return store::shell_text(words);
}

} // namespace gnomon::cli
