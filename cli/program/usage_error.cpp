#include "cli/program/usage_error.hpp"

#include "scene/job/file.hpp"
#include "scene/nearest_word.hpp"
#include "scene/one_line.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <vector>

namespace gnomon::cli {
namespace {

/// The command that was being read: of `gnomon baseline save` the last.
const CLI::App& innermost(const CLI::App& program)
{
    const CLI::App* app = &program;
    while (!app->get_subcommands().empty()) {
        app = app->get_subcommands().front();
    }
    return *app;
}

/// "gnomon baseline save"
std::string full_name(const CLI::App& app)
{
    return app.get_parent() == nullptr ? app.get_name()
                                       : full_name(*app.get_parent()) + " " + app.get_name();
}

std::vector<std::string> option_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

} // namespace

std::vector<std::string> command_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(below->get_name());
    }
    return names;
}

std::string usage_error(const CLI::App& program, const CLI::ParseError& error)
{
    const CLI::App& app = innermost(program);
    const std::string help = fmt::format("`{} --help`", full_name(app));
    const std::vector<std::string> unknown = app.remaining();
    if (unknown.empty()) {
        return fmt::format("{}; see {}", error.what(), help);
    }
    const std::string& word = unknown.front();
    const bool is_option = word.starts_with('-');
    const std::vector<std::string> known = is_option ? option_names(app) : command_names(app);
    if (known.empty()) { // no command of this one's own: an argument too many
        return fmt::format("{}; see {}", error.what(), help);
    }
    const bool is_letter = is_option && !word.starts_with("--"); // which is near to every word
    const std::string similar =
        is_letter ? std::string{} : scene::similar_word(word.substr(0, word.find('=')), known);
    return fmt::format("unknown {} {}; {}{} lists them", is_option ? "option" : "command",
                       scene::one_line(word),
                       similar.empty() ? "" : fmt::format("did you mean {}? ", similar), help);
}

} // namespace gnomon::cli
