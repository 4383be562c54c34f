#include "cli/commands.hpp"
#include "cli/exit_codes.hpp"
#include "cli/process.hpp"
#include "cli/standard_output.hpp"
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
        gnomon::cli::describe_program(program);
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
