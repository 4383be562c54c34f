#include "cpp/program.hpp"

#include <signal.h> // NOLINT(modernize-deprecated-headers): sigaction() is POSIX's
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <initializer_list>
#include <iostream>
#include <stdexcept>
#include <string>

namespace engine {
namespace {

volatile sig_atomic_t server_process = 0; ///< ends with the adapter, also at a signal

extern "C" void end_at_once(int)
{
    if (server_process != 0) {
        kill(server_process, SIGTERM);
        waitpid(server_process, nullptr, 0);
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

/// Sets up the rasterizer, and returns the requested mask.
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

/// In the child process: becomes the server, which writes its display number to the file.
[[noreturn]] void become_server(int file)
{
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    const std::string number = std::to_string(file);
    execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "64x64x24", "+extension",
           "GLX", "-nolisten", "tcp", static_cast<char*>(nullptr));
    _exit(1);
}

} // namespace

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

Xvfb::Xvfb()
{
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) {
        throw std::runtime_error{"pipe() failed"};
    }
    process_ = fork();
    if (process_ == 0) {
        close(ends[0]);
        become_server(ends[1]);
    }
    server_process = process_;
    close(ends[1]);
    std::string display{":"};
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) {
        display += c;
    }
    close(ends[0]);
    if (display.size() == 1) {
        throw std::runtime_error{"Xvfb does not start; is it installed (xvfb)?"};
    }
    setenv("DISPLAY", display.c_str(), 1);
}

Xvfb::~Xvfb()
{
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    server_process = 0;
}

} // namespace engine
