#include "cli/baseline_command.hpp"
#include "cli/capture_kit_command.hpp"
#include "cli/certify_command.hpp"
#include "cli/compare_command.hpp"
#include "cli/completion.hpp"
#include "cli/depth_command.hpp"
#include "cli/doctor_command.hpp"
#include "cli/evaluate_command.hpp"
#include "cli/exit_codes.hpp"
#include "cli/figure_command.hpp"
#include "cli/gate_command.hpp"
#include "cli/merge_command.hpp"
#include "cli/process.hpp"
#include "cli/report_command.hpp"
#include "cli/simple_commands.hpp"
#include "cli/standard_output.hpp"
#include "cli/status_command.hpp"
#include "cli/sweep_command.hpp"
#include "cli/tune_command.hpp"
#include "scene/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace exit_codes = gnomon::cli::exit_codes;

/// One line on stderr: messages of libraries may hold more.
void complain(std::string message)
{
    for (char& c : message) {
        if (c == '\n') {
            c = ' ';
        }
    }
    std::fprintf(stderr, "gnomon: %s\n", message.c_str());
}

void describe(CLI::App& program)
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
    gnomon::cli::add_compare_command(program);
    gnomon::cli::add_certify_command(program);
    gnomon::cli::add_tune_command(program);
    gnomon::cli::add_sweep_command(program);
    gnomon::cli::add_merge_command(program);
    gnomon::cli::add_status_command(program);
    gnomon::cli::add_report_command(program);
    gnomon::cli::add_gate_command(program);
    gnomon::cli::add_baseline_command(program);
    gnomon::cli::add_evaluate_command(program);
    gnomon::cli::add_capture_kit_command(program);
    gnomon::cli::add_figure_command(program);
    gnomon::cli::add_depth_command(program);
    gnomon::cli::add_scenes_command(program);
    gnomon::cli::add_init_command(program);
    gnomon::cli::add_doctor_command(program);
    gnomon::cli::add_completion_command(program);
}

/// What a wrong command line lacks or has too much of. Without a known command CLI11 asks for one
/// and keeps silent about the word that it could not take for one.
std::string usage_error(const CLI::App& program, const CLI::ParseError& error)
{
    const std::vector<std::string> unknown = program.remaining();
    if (program.get_subcommands().empty() && !unknown.empty()) {
        const char* const kind = unknown.front().starts_with('-') ? "option" : "command";
        return fmt::format("unknown {} {}; `gnomon --help` lists them", kind, unknown.front());
    }
    return fmt::format("{}; see `gnomon --help`", error.what());
}

int run(CLI::App& program, int argc, char** argv)
{
    try {
        program.parse(argc, argv);
        return exit_codes::done;
    } catch (const CLI::RuntimeError& error) {
        return error.get_exit_code();
    } catch (const CLI::Success& request) {
        std::ostringstream text; // --help, --version
        const int code = program.exit(request, text);
        gnomon::cli::print(text.str());
        return code;
    } catch (const CLI::ParseError& error) {
        complain(usage_error(program, error));
        return exit_codes::bad_input;
    }
}

} // namespace

int main(int argc, char** argv)
{
    gnomon::cli::keep_standard_streams();
    gnomon::cli::clean_up_on_signals();
    try {
        CLI::App program{"Gnomon measures how accurate GL shadow maps are: every pixel's verdict "
                         "against shadow rays."};
        describe(program);
        return run(program, argc, argv);
    } catch (const gnomon::scene::InputError& error) {
        complain(error.what());
        return exit_codes::bad_input;
    } catch (const gnomon::cli::ReaderGone&) {
        return exit_codes::environment_failed;
    } catch (const gnomon::scene::EnvironmentError& error) {
        complain(error.what());
        return exit_codes::environment_failed;
    } catch (const std::bad_alloc&) {
        complain("out of memory: use a smaller scene, image or map");
        return exit_codes::environment_failed;
    } catch (const std::exception& error) {
        complain(std::string{"internal error: "} + error.what() +
                 ": report it with the command and the output of `gnomon doctor`");
        return exit_codes::environment_failed;
    }
}
