#include "cli/commands.hpp"

#include "cli/system/process.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

using AddCommand = void (*)(CLI::App&);

/// Every command, in the order of the help.
constexpr auto commands = std::to_array<AddCommand>(
    {add_compare_command,        add_certify_command,     add_tune_command,
     add_settings_command,       add_sweep_command,       add_plan_command,
     add_run_unit_command,       add_merge_command,       add_status_command,
     add_report_command,         add_gate_command,        add_baseline_command,
     add_evaluate_command,       add_capture_kit_command, add_renderers_command,
     add_renderer_check_command, add_figure_command,      add_depth_command,
     add_scenes_command,         add_methods_command,     add_presets_command,
     add_init_command,           add_doctor_command,      add_completion_command,
     add_manual_command,         add_help_command});

/// The innermost command on the command line: `save` in `gnomon baseline save`.
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

std::vector<std::string> command_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* below : commands_below(app)) {
        names.push_back(below->get_name());
    }
    return names;
}

/// @throws scene::InputError  if there is no such command; names the nearest one.
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

void describe_program(CLI::App& program)
{
    program.name("gnomon");
    program.require_subcommand(1);
    program.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    program.footer(
        "Examples:\n"
        "  gnomon compare --builtin sphere-plane\n"
        "  gnomon compare model.glb --set scene.ground=true --picture model.png\n"
        "  gnomon init job.toml\n\n"
        "Exit status: 0 done; 1 `gate` finds a regression, `certify` refutes, no setting meets\n"
        "`tune`'s limits, or `evaluate --check` finds a mistake; 2 usage, or a job, scene or case "
        "that is\nbad, missing or unreadable; 3 a baseline is missing, or of another environment; "
        "4 GL, Embree\nor output failed; 5 a run is incomplete; 130 interrupted.");
    for (const AddCommand add : commands) {
        add(program);
    }
}

std::vector<const CLI::App*> commands_below(const CLI::App& app)
{
    return app.get_subcommands([](const CLI::App*) { return true; });
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
    if (known.empty()) { // the command has no commands below it: the word is an excess argument
        return fmt::format("{}; see {}", error.what(), help);
    }
    const bool is_letter = is_option && !word.starts_with("--"); // similar to every word
    const std::string similar =
        is_letter ? std::string{} : scene::similar_word(word.substr(0, word.find('=')), known);
    return fmt::format("unknown {} {}; {}{} lists them", is_option ? "option" : "command",
                       scene::one_line(word),
                       similar.empty() ? "" : fmt::format("did you mean {}? ", similar), help);
}

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
        // App::help() would print the help of the running command, `help`.
        print(app->get_formatter()->make_help(app, full_name, CLI::AppFormatMode::Normal));
    });
}

} // namespace gnomon::cli
