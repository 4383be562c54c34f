#include "cli/system/process.hpp"

#include "scene/text.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;

/// The process whose temporary files are removed: forks inherit the handler, but own no files.
volatile pid_t owner = 0;

volatile std::sig_atomic_t may_stop = 0; ///< work can stop by itself
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
        // open() takes the lowest free number, which is `fd`; writing to it still fails.
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

void print(std::string_view text)
{
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0) {
        if (errno == EPIPE) {
            throw BrokenPipe{};
        }
        throw scene::EnvironmentError(fmt::format(
            "standard output: {}: free space or write elsewhere", std::strerror(errno)));
    }
}

fs::path data_folder(const char* from_program, const char* in_source)
{
    std::error_code none;
    const fs::path program = fs::read_symlink("/proc/self/exe", none);
    const fs::path installed = program.parent_path() / from_program;
    return fs::is_directory(installed, none) ? installed.lexically_normal() : fs::path{in_source};
}

fs::path temporary_folder()
{
    std::error_code error;
    fs::path folder = fs::temp_directory_path(error);
    if (error) {
        throw scene::EnvironmentError(
            fmt::format("TMPDIR: {}; set it to a writable folder", error.message()));
    }
    return folder;
}

fs::path make_temporary_folder(const fs::path& parent, std::string_view prefix)
{
    std::string name = (parent / fmt::format("{}-XXXXXX", prefix)).string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw scene::EnvironmentError(fmt::format(
            "mkdtemp in {} failed: {}", scene::one_line(parent.string()), std::strerror(errno)));
    }
    return fs::canonical(name);
}

} // namespace gnomon::cli
