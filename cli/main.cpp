#include "cli/commands.hpp"
#include "cli/exit_codes.hpp"
#include "cli/system/guarded_process.hpp"
#include "cli/system/process.hpp"
#include "scene/error.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <system_error>

namespace {

namespace exit_codes = gnomon::cli::exit_codes;

/// Prints one line on stderr; messages of libraries may have several.
void print_error(std::string message)
{
    for (char& c : message) {
        if (c == '\n') {
            c = ' ';
        }
    }
    std::fprintf(stderr, "gnomon: %s\n", message.c_str());
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
        print_error(gnomon::cli::usage_error(program, error));
        return exit_codes::bad_input;
    }
}

std::string unexpected_error(const std::exception& error)
{
    const auto* const system = dynamic_cast<const std::system_error*>(&error);
    if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) {
        return "no thread can be started: free memory, or allow more processes (ulimit -u, -v)";
    }
    return std::string{"internal error: "} + error.what() +
           ": report it with the command and the output of `gnomon doctor`";
}

} // namespace

int main(int argc, char** argv)
{
    if (argc > 1 && argv[1] == gnomon::cli::guard_word) {
        return gnomon::cli::guard_process(argc, argv);
    }
    gnomon::cli::keep_standard_streams();
    gnomon::cli::clean_up_on_signals();
    try {
        CLI::App program{"Gnomon measures how accurate GL shadow maps are: every pixel's verdict "
                         "against shadow rays."};
        gnomon::cli::describe_program(program);
        return run(program, argc, argv);
    } catch (const gnomon::scene::InputError& error) {
        print_error(error.what());
        return exit_codes::bad_input;
    } catch (const gnomon::cli::BrokenPipe&) {
        return exit_codes::environment_failed;
    } catch (const gnomon::scene::EnvironmentError& error) {
        print_error(error.what());
        return exit_codes::environment_failed;
    } catch (const std::bad_alloc&) {
        print_error("out of memory: use a smaller scene, image or map");
        return exit_codes::environment_failed;
    } catch (const std::exception& error) {
        print_error(unexpected_error(error));
        return exit_codes::environment_failed;
    }
}
