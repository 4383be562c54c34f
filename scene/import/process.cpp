#include "scene/import/process.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <utility>

namespace gnomon::scene {

namespace {

constexpr int output_fd = STDERR_FILENO + 1; ///< in the child
constexpr std::uint64_t base_time_s = 5;     ///< of computing
constexpr std::uint64_t base_clock_s = 8;    ///< wall-clock time: other programs use the cores, too
constexpr double hung_below_s = 0.5;         ///< of computing, when the clock ran out
constexpr std::uint64_t bytes_per_s = 2'000'000;
constexpr std::uint64_t bytes_per_clock_s = 4'000'000;
constexpr std::uint64_t base_memory_bytes = 1ULL << 30U;
constexpr std::uint64_t memory_bytes_per_byte = 256;

#ifdef __SANITIZE_ADDRESS__
constexpr bool limits_address_space = false; // its shadow memory spans terabytes
#else
constexpr bool limits_address_space = true;
#endif

/// Owns a file descriptor.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_{fd} {}
    Descriptor(Descriptor&& other) noexcept : fd_{std::exchange(other.fd_, -1)} {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~Descriptor()
    {
        if (fd_ >= 0) {
            ::close(fd_);
        }
    }
    [[nodiscard]] int get() const { return fd_; }

private:
    int fd_;
};

std::uint64_t address_space_bytes()
{
    std::uint64_t pages = 0;
    std::ifstream{"/proc/self/statm"} >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void set_limit(decltype(RLIMIT_CPU) resource, std::uint64_t soft, std::uint64_t hard)
{
    const rlimit limit{std::min(soft, hard), hard};
    // A stricter inherited hard limit stays in force.
    (void)::setrlimit(resource, &limit);
}

/// Isolates the child: it keeps only memory, its output and /dev/null.
void isolate(int output)
{
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV,
                             SIGTERM, SIGPIPE, SIGALRM, SIGXCPU, SIGXFSZ}) {
        ::signal(signal, SIG_DFL);
    }
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    ::dup2(output, output_fd);
    const int null = ::open("/dev/null", O_RDWR);
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        ::dup2(null, fd);
    }
    ::close_range(output_fd + 1, ~0U, 0);
    // When memory runs short, the system should end this process and not its parent.
    std::ofstream{"/proc/self/oom_score_adj"} << 1000;
}

[[noreturn]] void run_child(int output, pid_t parent, const ImportLimits& limits,
                            const std::function<void(int, ImportAllowance&)>& work)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) {
        ::_exit(EXIT_FAILURE);
    }
    isolate(output);
    try {
        ImportAllowance allowance{limits};
        work(output_fd, allowance);
    } catch (...) {
        ::_exit(EXIT_FAILURE);
    }
    ::_exit(EXIT_SUCCESS);
}

/// Waits until the child ends or the deadline passes; returns whether it ended.
bool ended_in_time(const Descriptor& child, std::chrono::seconds time)
{
    const auto deadline = std::chrono::steady_clock::now() + time;
    while (true) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            deadline - std::chrono::steady_clock::now());
        pollfd event{child.get(), POLLIN, 0};
        const auto wait_ms = std::clamp<std::int64_t>(left.count(), 0, 1'000'000);
        const int ready = ::poll(&event, 1, static_cast<int>(wait_ms));
        if (ready > 0) {
            return true;
        }
        if (left.count() <= 0) {
            return false;
        }
    }
}

[[noreturn]] void throw_failure(const std::string& label, int status, bool in_time,
                                const ImportLimits& limits)
{
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (!in_time) {
        throw InputError{fmt::format("{}: the importer took longer than {} s: the file is damaged "
                                     "or too large; re-export it or split it",
                                     label, limits.time.count())};
    }
    if (signal == SIGXCPU || signal == SIGALRM) {
        throw InputError{fmt::format("{}: the importer worked for longer than a file of its size "
                                     "should need: the file is damaged; re-export it",
                                     label)};
    }
    if (signal == SIGXFSZ) {
        throw InputError{
            fmt::format("{}: the scene takes more than {} MiB once flattened; split it", label,
                        limits.memory_bytes >> 20U)};
    }
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) {
        throw InputError{
            fmt::format("{}: the import was interrupted (signal {}); repeat it", label, signal)};
    }
    const std::string way = signal != 0 ? fmt::format("signal {}", signal) : "no message";
    throw InputError{fmt::format("{}: the importer crashed ({}): the file is damaged; re-export it",
                                 label, way)};
}

[[noreturn]] void throw_errno(const char* call)
{
    throw EnvironmentError{fmt::format("{} failed: {} (errno {}); free memory or processes, then "
                                       "repeat",
                                       call, std::strerror(errno), errno)};
}

/// How a child ended, and what it wrote.
struct Ended {
    Descriptor output;
    int status = 0;
    bool in_time = false;
    double computed_s = 0; ///< of CPU time

    [[nodiscard]] bool succeeded() const
    {
        return in_time && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
    }
    /// Whether it timed out while waiting, not computing. A fork copies only one thread: a lock
    /// that another thread of the parent held (in a sanitizer's allocator, in a driver) is never
    /// released in the child, which then waits until its time is up.
    [[nodiscard]] bool hung() const
    {
        const bool was_stopped = !in_time || (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM);
        return was_stopped && computed_s < hung_below_s;
    }
};

double seconds(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Ended run_once(const ImportLimits& limits, const std::function<void(int, ImportAllowance&)>& work)
{
    Ended ended{Descriptor{::memfd_create("gnomon-import", MFD_CLOEXEC | MFD_ALLOW_SEALING)}};
    if (ended.output.get() < 0) {
        throw_errno("memfd_create");
    }
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) {
        throw_errno("fork");
    }
    if (child == 0) {
        run_child(ended.output.get(), parent, limits, work);
    }
    // glibc 2.36 declares pidfd_open() with C++ linkage, so linking to it fails.
    const Descriptor watched{static_cast<int>(::syscall(SYS_pidfd_open, child, 0))};
    const int watch_error = errno;
    ended.in_time = watched.get() >= 0 && ended_in_time(watched, limits.time);
    if (!ended.in_time) {
        ::kill(child, SIGKILL);
    }
    rusage used{};
    while (::wait4(child, &ended.status, 0, &used) < 0 && errno == EINTR) {
    }
    if (watched.get() < 0) {
        errno = watch_error;
        throw_errno("pidfd_open");
    }
    ended.computed_s = seconds(used.ru_utime) + seconds(used.ru_stime);
    return ended;
}

} // namespace

SealedBytes::SealedBytes(int fd)
{
    struct stat facts {};
    if (::fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE) != 0 ||
        ::fstat(fd, &facts) != 0) {
        throw_errno("sealing the importer's output");
    }
    const auto size = static_cast<std::size_t>(facts.st_size);
    if (size == 0) {
        return;
    }
    void* memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
    if (memory == MAP_FAILED) {
        throw_errno("mapping the importer's output");
    }
    bytes_ = {static_cast<const std::byte*>(memory), size};
}

SealedBytes::SealedBytes(SealedBytes&& other) noexcept : bytes_{std::exchange(other.bytes_, {})} {}

SealedBytes& SealedBytes::operator=(SealedBytes&& other) noexcept
{
    std::swap(bytes_, other.bytes_);
    return *this;
}

SealedBytes::~SealedBytes()
{
    if (!bytes_.empty()) {
        ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
    }
}

ImportAllowance::ImportAllowance(const ImportLimits& limits)
    : limits_{limits},
      base_memory_bytes_{address_space_bytes()}
{
    set_limit(RLIMIT_CORE, 0, 0);
    set_limit(RLIMIT_FSIZE, limits.memory_bytes, limits.memory_bytes);
    apply();
}

void ImportAllowance::set_alarm() const
{
    const auto elapsed_s =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start_);
    const std::uint64_t allowed_s = base_clock_s + opened_bytes_ / bytes_per_clock_s;
    const std::uint64_t capped_s = std::min<std::uint64_t>(allowed_s, 1U << 30U);
    const auto left_s = static_cast<std::int64_t>(capped_s) - elapsed_s.count();
    ::alarm(static_cast<unsigned>(std::max<std::int64_t>(left_s, 1)));
}

void ImportAllowance::add_file(std::uint64_t byte_count)
{
    opened_bytes_ = std::min(opened_bytes_ + byte_count, limits_.memory_bytes);
    apply();
}

void ImportAllowance::apply() const
{
    const auto time_s = static_cast<std::uint64_t>(std::max<std::int64_t>(limits_.time.count(), 1));
    set_alarm();
    set_limit(RLIMIT_CPU, base_time_s + opened_bytes_ / bytes_per_s, time_s);
    if (limits_address_space) {
        const std::uint64_t allowed = base_memory_bytes + opened_bytes_ * memory_bytes_per_byte;
        set_limit(RLIMIT_AS, base_memory_bytes_ + std::min(allowed, limits_.memory_bytes),
                  base_memory_bytes_ + limits_.memory_bytes);
    }
}

SealedBytes run_in_child(const std::string& label, const ImportLimits& limits,
                         const std::function<void(int, ImportAllowance&)>& work)
{
    Ended ended = run_once(limits, work);
    if (ended.hung()) {
        ended = run_once(limits, work);
    }
    if (!ended.succeeded()) {
        throw_failure(label, ended.status, ended.in_time, limits);
    }
    return SealedBytes{ended.output.get()};
}

} // namespace gnomon::scene
