#include "cli/commands.hpp"

#include "cli/program/usage_error.hpp"
#include "cli/system/standard_output.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/nearest_word.hpp"
#include "scene/one_line.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

/// @throws scene::InputError  naming the nearest command.
const CLI::App& command_below(const CLI::App& app, const std::string& name)
{
    const std::vector<std::string> names = command_names(app);
    if (std::ranges::find(names, name) != names.end()) {
        return *app.get_subcommand(name);
    }
    const std::string unknown = fmt::format("help: unknown command {}", scene::one_line(name));
    if (names.empty()) {
        throw scene::InputError(fmt::format("{}; {} has none below it", unknown, app.get_name()));
    }
    const std::string nearest = scene::similar_word(name, names);
    throw scene::InputError(fmt::format("{}; {}", unknown,
                                        nearest.empty()
                                            ? std::string{"`gnomon --help` lists them"}
                                            : fmt::format("did you mean {}?", nearest)));
}

} // namespace

void add_help_command(CLI::App& program)
{
    auto names = std::make_shared<std::vector<std::string>>();
    CLI::App* command = program.add_subcommand("help", "Print what --help prints, of a command");
    command->add_option("COMMAND", *names, "Which; default: the program");
    command->footer("Examples:\n"
                    "  gnomon help compare\n"
                    "  gnomon help baseline save");
    command->callback([&program, names] {
        const CLI::App* app = &program;
        std::string full_name = app->get_name();
        for (const std::string& name : *names) {
            app = &command_below(*app, name);
            full_name += " " + name;
        }
        // Not the program's own `help`, which would be that of the command being run: this one.
        print(app->get_formatter()->make_help(app, full_name, CLI::AppFormatMode::Normal));
    });
}

} // namespace gnomon::cli
