#include "cpp/program.hpp"

#include <signal.h> // NOLINT(modernize-deprecated-headers): sigaction() is POSIX's
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <initializer_list>
#include <iostream>
#include <stdexcept>
#include <string>

namespace engine {
namespace {

volatile sig_atomic_t process_of_program = 0;

extern "C" void end_at_once(int)
{
    if (process_of_program != 0) {
        kill(process_of_program, SIGTERM);
        waitpid(process_of_program, nullptr, 0);
    }
    _exit(1);
}

void end_at_signals()
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        action.sa_handler = end_at_once;
        sigaction(signal, &action, nullptr);
    }
}

/// Chooses the rasterizer, and says which mask is asked for.
Mask read_options(int argc, char** argv)
{
    Mask mask = Mask::shader;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word == "--rasterizer=softpipe") {
            setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
            setenv("GALLIUM_DRIVER", "softpipe", 1);
        } else if (word == "--mask=picture") {
            mask = Mask::picture;
        } else if (word != "--rasterizer=system" && word != "--mask=shader") {
            throw std::runtime_error{
                "unknown option " + std::string{word} +
                "; --rasterizer=system|softpipe and --mask=shader|picture are known"};
        }
    }
    return mask;
}

} // namespace

void end_process_with_program(int process)
{
    process_of_program = process;
}

int run(std::string_view name, int argc, char** argv,
        const std::function<std::unique_ptr<Engine>(Mask)>& make)
{
    try {
        end_at_signals();
        const Mask mask = read_options(argc, argv);
        const int answers = take_standard_output();
        const std::unique_ptr<Engine> engine = make(mask);
        serve(*engine, answers);
        return 0;
    } catch (const std::exception& problem) {
        std::cerr << name << ": " << problem.what() << std::endl;
        return 1;
    }
}

} // namespace engine
