#include "cli/certify_command.hpp"
#include "cli/compare_command.hpp"
#include "cli/completion.hpp"
#include "cli/doctor_command.hpp"
#include "cli/simple_commands.hpp"
#include "scene/error.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace {

enum ExitCode : int { done = 0, bad_input = 2, environment_failed = 4 };

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
    program.footer("Examples:\n"
                   "  gnomon compare --builtin sphere-plane\n"
                   "  gnomon compare model.glb --set scene.ground=true --picture model.png\n"
                   "  gnomon init job.toml\n\n"
                   "Exit status: 0 done; 1 `certify` refutes; 2 usage, or a job or scene that is\n"
                   "bad, missing or unreadable; 4 GL, Embree or output failed.");
    gnomon::cli::add_compare_command(program);
    gnomon::cli::add_certify_command(program);
    gnomon::cli::add_scenes_command(program);
    gnomon::cli::add_init_command(program);
    gnomon::cli::add_doctor_command(program);
    gnomon::cli::add_completion_command(program);
}

int run(CLI::App& program, int argc, char** argv)
{
    try {
        program.parse(argc, argv);
        return done;
    } catch (const CLI::RuntimeError& error) {
        return error.get_exit_code();
    } catch (const CLI::Success& request) {
        return program.exit(request); // --help, --version
    } catch (const CLI::ParseError& error) {
        complain(std::string{error.what()} + "; see `gnomon --help`");
        return bad_input;
    }
}

} // namespace

int main(int argc, char** argv)
{
    try {
        CLI::App program{"Gnomon measures how accurate GL shadow maps are: every pixel's verdict "
                         "against shadow rays."};
        describe(program);
        return run(program, argc, argv);
    } catch (const gnomon::scene::InputError& error) {
        complain(error.what());
        return bad_input;
    } catch (const gnomon::scene::EnvironmentError& error) {
        complain(error.what());
        return environment_failed;
    } catch (const std::bad_alloc&) {
        complain("out of memory: use a smaller scene, image or map");
        return environment_failed;
    } catch (const std::exception& error) {
        complain(std::string{"internal error: "} + error.what() +
                 ": report it with the command and the output of `gnomon doctor`");
        return environment_failed;
    }
}
