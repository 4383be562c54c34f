#include "child_process.hpp"

#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <fcntl.h>
#include <grp.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace gnomon::testing {

namespace {

/// A file in memory that a process writes to.
class Capture {
public:
    Capture() : fd_{::memfd_create("capture", MFD_CLOEXEC)}
    {
        if (fd_ < 0) {
            throw std::system_error{errno, std::generic_category(), "memfd_create"};
        }
    }
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;
    ~Capture() { ::close(fd_); }

    [[nodiscard]] int fd() const { return fd_; }
    [[nodiscard]] std::string text() const
    {
        std::string text;
        std::array<char, 65536> buffer{};
        ssize_t got = 0;
        while ((got = ::pread(fd_, buffer.data(), buffer.size(), static_cast<off_t>(text.size()))) >
               0) {
            text.append(buffer.data(), static_cast<std::size_t>(got));
        }
        return text;
    }

private:
    int fd_;
};

std::vector<char*> pointers(std::vector<std::string>& texts)
{
    std::vector<char*> result;
    for (std::string& text : texts) {
        result.push_back(text.data());
    }
    result.push_back(nullptr);
    return result;
}

void redirect_stdout(const Start& start, int captured)
{
    if (start.closes_stdout) {
        ::close(STDOUT_FILENO);
        return;
    }
    std::array<int, 2> pipe{};
    if (start.breaks_stdout && ::pipe(pipe.data()) == 0) {
        ::dup2(pipe[1], STDOUT_FILENO);
        ::close(pipe[0]);
        ::close(pipe[1]);
        return;
    }
    const int target =
        start.stdout_path.empty() ? captured : ::open(start.stdout_path.c_str(), O_WRONLY);
    ::dup2(target, STDOUT_FILENO);
}

/// In the child, after fork().
[[noreturn]] void become(char* const* arguments, const Start& start, int out, int err)
{
    ::setpgid(0, 0);
    // The caller may ignore these signals (nohup), and children inherit that.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) {
        ::signal(signal, SIG_DFL);
    }
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(err, STDERR_FILENO);
    redirect_stdout(start, out);
    // LeakSanitizer crashes now and then while a GL driver's threads end. leaks_test.cpp runs it
    // and repeats crashed checks.
    ::setenv("ASAN_OPTIONS", "detect_leaks=0", 0);
    for (const std::string& setting : start.environment) {
        ::putenv(const_cast<char*>(setting.c_str()));
    }
    if (start.address_space_bytes != 0) {
        const rlimit limit{start.address_space_bytes, start.address_space_bytes};
        ::setrlimit(RLIMIT_AS, &limit);
    }
    if (start.file_bytes != 0) {
        const rlimit limit{start.file_bytes, start.file_bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (start.user_id != 0 && (::setgroups(0, nullptr) != 0 || ::setgid(start.user_id) != 0 ||
                               ::setuid(start.user_id) != 0)) {
        ::_exit(126);
    }
    ::execvp(arguments[0], arguments);
    ::_exit(127);
}

/// Waits at most `longest_s`, then kills the process and its children.
void wait_for(pid_t child, double longest_s, Ending& ending)
{
    const auto begin = std::chrono::steady_clock::now();
    int status = 0;
    rusage usage{};
    while (::wait4(child, &status, WNOHANG, &usage) == 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds{2});
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
        ending.time_s = time.count();
        if (ending.time_s > longest_s) {
            ::kill(-child, SIGKILL);
        }
    }
    ending.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    ending.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    ending.peak_memory_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// What is left of stderr without the lines that name output files.
std::string without_named_files(const std::string& err)
{
    static const std::regex named{"gnomon [a-z]+: wrote [^\n]+\n"};
    return std::regex_replace(err, named, "");
}

} // namespace

Ending run(const std::vector<std::string>& command, const Start& start)
{
    const Capture out;
    const Capture err;
    std::vector<std::string> arguments = command;
    const std::vector<char*> argv = pointers(arguments);
    Ending ending;
    ending.command = fmt::format("{}", fmt::join(command, " "));
    const pid_t child = ::fork();
    if (child < 0) {
        throw std::system_error{errno, std::generic_category(), "fork"};
    }
    if (child == 0) {
        become(argv.data(), start, out.fd(), err.fd());
    }
    if (start.while_running) {
        start.while_running(child);
    }
    wait_for(child, start.longest_s, ending);
    ending.out = out.text();
    ending.err = err.text();
    return ending;
}

Ending gnomon(std::vector<std::string> arguments, const Start& start)
{
    arguments.insert(arguments.begin(), GNOMON_PROGRAM);
    return run(arguments, start);
}

std::vector<std::string> small(std::vector<std::string> arguments)
{
    arguments.insert(arguments.end(), {"--set", "image.width=160", "--set", "image.height=90"});
    return arguments;
}

void expect_refused(const Ending& ending, int exit_code, const std::string& text)
{
    using ::testing::HasSubstr;
    using ::testing::StartsWith;
    SCOPED_TRACE(ending.command);
    EXPECT_EQ(ending.exit_code, exit_code) << "signal " << ending.signal;
    EXPECT_EQ(ending.out, "");
    const std::string err = without_named_files(ending.err);
    EXPECT_THAT(err, StartsWith("gnomon: "));
    EXPECT_THAT(err, HasSubstr(text));
    EXPECT_EQ(err.find('\n'), err.size() - 1) << err;
}

void expect_done(const Ending& ending)
{
    SCOPED_TRACE(ending.command);
    EXPECT_EQ(ending.exit_code, 0) << "signal " << ending.signal;
    EXPECT_EQ(without_named_files(ending.err), "");
}

bool is_installed(const std::string& name)
{
    return run({"sh", "-c", "command -v " + name}).exit_code == 0;
}

std::vector<std::filesystem::path> test_models()
{
    std::vector<std::filesystem::path> found;
    std::error_code missing;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(test_models_folder, missing)) {
        const std::string extension = entry.path().extension().string();
        for (const std::string_view known : {".gltf", ".glb", ".obj", ".ply"}) {
            if (extension == known && entry.is_regular_file()) {
                found.push_back(entry.path());
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::string text_of(const std::filesystem::path& file)
{
    std::ifstream stream{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{stream}, {}};
}

} // namespace gnomon::testing
