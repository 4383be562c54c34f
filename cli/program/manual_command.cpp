#include "cli/commands.hpp"

#include "cli/system/process.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <sstream>
#include <string_view>
#include <vector>

namespace gnomon::cli {
namespace {

struct ManualOption {
    std::string name; ///< with its value's type: "--builtin TEXT"
    std::string description;
};

struct ManualCommand {
    std::string name; ///< "gnomon compare"
    std::string description;
    std::vector<ManualOption> options; ///< positional ones first
    std::string footer;
};

/// The option's type or, if it has one, its check: CLI11 writes TYPE:CHECK.
std::string value_type(const CLI::Option& option)
{
    const std::string type = option.get_type_name();
    return type.substr(type.find(':') + 1); // npos + 1 = 0
}

ManualOption manual_option(const CLI::Option& option)
{
    std::string name =
        option.get_positional() ? option.get_name(true) : option.get_name(false, true);
    const std::string type = value_type(option);
    if (!option.get_positional() && !type.empty()) {
        name += " " + type;
    }
    std::string description = option.get_description();
    if (!option.get_default_str().empty()) {
        description += fmt::format(" (default: {})", option.get_default_str());
    }
    return {std::move(name), std::move(description)};
}

ManualCommand manual_command(const CLI::App& app, const std::string& parent)
{
    ManualCommand command{
        parent + " " + app.get_name(), app.get_description(), {}, app.get_footer()};
    for (const bool is_positional : {true, false}) {
        for (const CLI::Option* option : app.get_options()) {
            if (option->get_positional() == is_positional && option != app.get_help_ptr()) {
                command.options.push_back(manual_option(*option));
            }
        }
    }
    return command;
}

/// The commands below an app, each followed by those below it.
void append_commands(const CLI::App& app, const std::string& name,
                     std::vector<ManualCommand>& commands)
{
    for (const CLI::App* below : commands_below(app)) {
        commands.push_back(manual_command(*below, name));
        append_commands(*below, commands.back().name, commands);
    }
}

std::vector<ManualCommand> all_commands(const CLI::App& program)
{
    std::vector<ManualCommand> commands;
    append_commands(program, program.get_name(), commands);
    return commands;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream{text};
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// Escapes a line for roff: no backslash or leading dot is a request, and hyphens are minus signs.
std::string roff(const std::string& line)
{
    std::string text = line.starts_with('.') || line.starts_with('\'') ? "\\&" : "";
    for (const char c : line) {
        if (c == '\\') {
            text += "\\e";
        } else if (c == '-') {
            text += "\\-";
        } else {
            text += c;
        }
    }
    return text;
}

/// Lines as they stand.
std::string roff_block(const std::string& text)
{
    std::string block = ".nf\n";
    for (const std::string& line : lines_of(text)) {
        block += roff(line) + "\n";
    }
    return block + ".fi\n";
}

/// Escapes a cell of a Markdown table.
std::string cell(std::string_view text)
{
    std::string escaped;
    for (const char c : text) {
        if (c == '|') {
            escaped += '\\';
        }
        escaped += c == '\n' ? ' ' : c;
    }
    return escaped;
}

std::string manual_page(const CLI::App& program)
{
    std::string page = fmt::format(".TH GNOMON 1 \"\" \"gnomon {}\" \"User Commands\"\n"
                                   ".SH NAME\ngnomon \\- how accurate GL shadow maps are\n"
                                   ".SH SYNOPSIS\n.B gnomon\n.I COMMAND\n.RI [ OPTIONS ]\n"
                                   ".SH DESCRIPTION\n{}\n.SH COMMANDS\n",
                                   roff(GNOMON_VERSION), roff(program.get_description()));
    for (const ManualCommand& command : all_commands(program)) {
        page += fmt::format(".SS {}\n{}\n", roff(command.name), roff(command.description));
        for (const ManualOption& option : command.options) {
            page +=
                fmt::format(".TP\n.B {}\n{}\n", roff(option.name), roff(cell(option.description)));
        }
        if (!command.footer.empty()) {
            page += ".PP\n" + roff_block(command.footer);
        }
    }
    return page + ".SH NOTES\n" + roff_block(program.get_footer());
}

std::string manual_markdown(const CLI::App& program)
{
    std::string text = fmt::format("# Commands\n\n{}\n\n```text\n{}\n```\n",
                                   program.get_description(), program.get_footer());
    for (const ManualCommand& command : all_commands(program)) {
        text += fmt::format("\n## {}\n\n{}.\n", command.name, command.description);
        if (!command.options.empty()) {
            text += "\n| option | meaning |\n|---|---|\n";
        }
        for (const ManualOption& option : command.options) {
            text += fmt::format("| `{}` | {} |\n", cell(option.name), cell(option.description));
        }
        if (!command.footer.empty()) {
            text += fmt::format("\n```text\n{}\n```\n", command.footer);
        }
    }
    return text;
}

} // namespace

void add_manual_command(CLI::App& program)
{
    auto is_markdown = std::make_shared<bool>(false);
    CLI::App* command =
        program.add_subcommand("manual", "Print the manual page of all commands and options");
    command->add_flag("--markdown", *is_markdown, "As docs/commands.md has it, in place of roff");
    command->footer("Examples:\n"
                    "  gnomon manual > gnomon.1 && man -l gnomon.1");
    command->callback([&program, is_markdown] {
        print(*is_markdown ? manual_markdown(program) : manual_page(program));
    });
}

} // namespace gnomon::cli
