#include "cpp/xvfb.hpp"

#include "cpp/program.hpp"

#include <signal.h> // NOLINT(modernize-deprecated-headers): SIGTERM for prctl()
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace engine {
namespace {

/// In the child: becomes the server, which writes its display's number to the file.
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
    end_process_with_program(process_);
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
    end_process_with_program(0);
}

} // namespace engine
