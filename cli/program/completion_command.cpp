#include "cli/commands.hpp"

#include "cli/figures/figures.hpp"
#include "cli/system/process.hpp"
#include "methods/key_table.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/presets/presets.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

namespace gnomon::cli {
namespace {

struct Flag {
    std::string name; ///< "--builtin"
    std::string description;
};

struct Command {
    std::string name;
    std::string description;
    std::vector<Flag> flags; ///< also those of the commands below it
    std::vector<std::string> commands;
};

void add_flags(Command& command, const CLI::App& app)
{
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            const std::string flag = "--" + name;
            if (std::none_of(command.flags.begin(), command.flags.end(),
                             [&](const Flag& known) { return known.name == flag; })) {
                command.flags.push_back({flag, option->get_description()});
            }
        }
    }
}

std::vector<Command> commands_of(const CLI::App& program)
{
    std::vector<Command> commands;
    for (const CLI::App* app : commands_below(program)) {
        Command command{app->get_name(), app->get_description(), {}, {}};
        add_flags(command, *app);
        for (const CLI::App* below : commands_below(*app)) {
            command.commands.push_back(below->get_name());
            add_flags(command, *below);
        }
        commands.push_back(std::move(command));
    }
    return commands;
}

std::string builtin_names()
{
    std::vector<std::string> names;
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        names.push_back(builtin.name);
    }
    return fmt::format("{}", fmt::join(names, " "));
}

std::string preset_names()
{
    std::vector<std::string> names;
    for (const scene::Preset& preset : scene::presets(*methods::key_table())) {
        names.push_back(preset.name);
    }
    return fmt::format("{}", fmt::join(names, " "));
}

std::string key_names()
{
    std::vector<std::string> names;
    for (const scene::Key& spec : methods::key_table()->rows()) {
        names.push_back(spec.name + "=");
    }
    return fmt::format("{}", fmt::join(names, " "));
}

std::string figure_names()
{
    std::vector<std::string> names;
    for (const FigureKind& kind : figure_kinds()) {
        names.push_back(kind.name);
    }
    return fmt::format("{}", fmt::join(names, " "));
}

std::string flag_names(const Command& command)
{
    std::vector<std::string> names;
    std::transform(command.flags.begin(), command.flags.end(), std::back_inserter(names),
                   [](const Flag& flag) { return flag.name; });
    return fmt::format("{}", fmt::join(names, " "));
}

/// The function for bash; zsh runs it through bashcompinit.
std::string bash_script(const std::vector<Command>& commands)
{
    std::vector<std::string> names;
    std::string cases;
    std::string below;
    for (const Command& command : commands) {
        names.push_back(command.name);
        if (!command.commands.empty()) {
            below += fmt::format(
                "        {}) COMPREPLY=($(compgen -W \"{} --help\" -- \"$current\")); return ;;\n",
                command.name, fmt::join(command.commands, " "));
        }
        cases += fmt::format("        {}) words=\"{}\" ;;\n", command.name, flag_names(command));
    }
    return fmt::format(R"(_gnomon() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD-1]}}" words=""
    case "$previous" in
        --builtin) COMPREPLY=($(compgen -W "{}" -- "$current")); return ;;
        --preset) COMPREPLY=($(compgen -W "{}" -- "$current")); return ;;
        --set) COMPREPLY=($(compgen -W "{}" -- "$current")); compopt -o nospace; return ;;
        --truth) COMPREPLY=($(compgen -W "exact float" -- "$current")); return ;;
        figure) COMPREPLY=($(compgen -W "{} --list --help" -- "$current")); return ;;
        completion) COMPREPLY=($(compgen -W "bash zsh fish" -- "$current")); return ;;
{}    esac
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "{} --help --version" -- "$current"))
        return
    fi
    case "${{COMP_WORDS[1]}}" in
{}    esac
    if [[ "$current" == -* ]]; then
        COMPREPLY=($(compgen -W "$words" -- "$current"))
    else
        COMPREPLY=($(compgen -f -- "$current"))
    fi
}}
complete -F _gnomon gnomon
)",
                       builtin_names(), preset_names(), key_names(), figure_names(), below,
                       fmt::join(names, " "), cases);
}

/// A string in single quotes, escaped for fish.
std::string fish_quoted(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '\'' || c == '\\') {
            result += '\\';
        }
        result += c;
    }
    return "'" + result + "'";
}

std::string fish_script(const std::vector<Command>& commands)
{
    std::string script = "complete -c gnomon -n __fish_use_subcommand -l version\n";
    for (const Command& command : commands) {
        script += fmt::format("complete -c gnomon -f -n __fish_use_subcommand -a {} -d {}\n",
                              command.name, fish_quoted(command.description));
        for (const Flag& flag : command.flags) {
            const std::string values = flag.name == "--builtin"  ? builtin_names()
                                       : flag.name == "--preset" ? preset_names()
                                       : flag.name == "--set"    ? key_names()
                                       : flag.name == "--truth"  ? "exact float"
                                                                 : "";
            script += fmt::format(
                "complete -c gnomon -n '__fish_seen_subcommand_from {}' -l {} -d {}{}\n",
                command.name, flag.name.substr(2), fish_quoted(flag.description),
                values.empty() ? "" : fmt::format(" -x -a {}", fish_quoted(values)));
        }
        if (!command.commands.empty()) {
            script +=
                fmt::format("complete -c gnomon -n '__fish_seen_subcommand_from {}' -a '{}'\n",
                            command.name, fmt::join(command.commands, " "));
        }
    }
    script += fmt::format("complete -c gnomon -n '__fish_seen_subcommand_from figure' -a '{}'\n",
                          figure_names());
    return script + "complete -c gnomon -f -n '__fish_seen_subcommand_from completion' -a 'bash "
                    "zsh fish'\n";
}

std::string completion_script(const CLI::App& program, const std::string& shell)
{
    const std::vector<Command> commands = commands_of(program);
    if (shell == "bash") {
        return bash_script(commands);
    }
    if (shell == "zsh") {
        return "#compdef gnomon\nautoload -U +X bashcompinit && bashcompinit\n" +
               bash_script(commands);
    }
    if (shell == "fish") {
        return fish_script(commands);
    }
    throw std::invalid_argument("completion_script: shell " + shell);
}

} // namespace

void add_completion_command(CLI::App& program)
{
    auto shell = std::make_shared<std::string>();
    CLI::App* command =
        program.add_subcommand("completion", "Print a completion script for a shell");
    command->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    command->footer("Examples:\n"
                    "  gnomon completion bash > ~/.local/share/bash-completion/completions/gnomon\n"
                    "  gnomon completion fish > ~/.config/fish/completions/gnomon.fish");
    command->callback([&program, shell] { print(completion_script(program, *shell)); });
}

} // namespace gnomon::cli
