#include "cli/system/process.hpp"

#include "store/output_file.hpp"

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <csignal>
#include <string_view>

namespace gnomon::cli {
namespace {

volatile pid_t owner = 0; ///< the process whose files these are; a fork has the handler too

/// Set by the first signal while work can stop by itself.
volatile std::sig_atomic_t may_stop = 0;
volatile std::sig_atomic_t must_stop = 0;

volatile pid_t child_to_end = 0;

void write_message(std::string_view message)
{
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), message.size());
}

extern "C" void end_process(int signal)
{
    if (::getpid() != owner) {
        ::_exit(128 + signal);
    }
    if (may_stop != 0 && must_stop == 0) {
        must_stop = 1;
        write_message("\ngnomon: interrupted; finishing what has begun (again: stop at once)\n");
        return;
    }
    if (child_to_end > 0) {
        ::kill(child_to_end, SIGTERM);
    }
    store::abandon_output_files();
    write_message("gnomon: interrupted; run it again\n");
    ::_exit(128 + signal);
}

} // namespace

void keep_standard_streams()
{
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        // The lowest free number is taken, so this is `fd` itself; writing to it fails as before.
        if (::fcntl(fd, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) < 0) {
            break; // no /dev/null: the streams stay closed
        }
    }
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    for (const int signal : {SIGPIPE, SIGXFSZ}) {
        ::sigaction(signal, &ignore, nullptr);
    }
}

void clean_up_on_signals()
{
    owner = ::getpid();
    struct sigaction action {};
    action.sa_handler = end_process;
    ::sigfillset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) {
            ::sigaction(signal, &action, nullptr);
        }
    }
}

void end_with_this_process(pid_t child)
{
    child_to_end = child;
}

void stop_on_signals()
{
    may_stop = 1;
}

bool is_interrupted()
{
    return must_stop != 0;
}

} // namespace gnomon::cli
