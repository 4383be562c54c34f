#include "store/run_folder/run_lock.hpp"

#include "scene/error.hpp"
#include "scene/one_line.hpp"
#include "store/run_folder/leftovers.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

namespace gnomon::store {

namespace {

constexpr mode_t lock_mode = 0666; ///< before the umask

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view call, int code)
{
    throw scene::EnvironmentError(
        fmt::format("cannot lock {}: {}: {} (errno {}); choose a folder that may be written, on a "
                    "disk that knows locks",
                    scene::one_line(path.string()), call,
                    std::error_code{code, std::generic_category()}.message(), code));
}

void make_folder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        fail(folder, "mkdir", error.value());
    }
}

/// The command line of this process, its words parted by blanks.
std::string command_line()
{
    constexpr std::size_t longest = 200;
    std::ifstream file{"/proc/self/cmdline", std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{file}, {}};
    while (text.ends_with('\0')) {
        text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\0', ' ');
    return scene::one_line(text.substr(0, longest));
}

std::string host_name()
{
    std::array<char, 256> name{};
    const bool known = ::gethostname(name.data(), name.size() - 1) == 0;
    return known ? name.data() : "an unknown host";
}

std::string description_of_this_process()
{
    const auto now =
        std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
    return fmt::format("process {} on {} since {:%F %T} UTC: {}\n", ::getpid(), host_name(),
                       fmt::gmtime(std::chrono::system_clock::to_time_t(now)), command_line());
}

/// Who wrote into the file that it holds the lock; it may be about to.
std::string holder(int descriptor)
{
    std::array<char, 1024> text{};
    const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
    if (size <= 0) {
        return "a process that has just started";
    }
    std::string line{text.data(), static_cast<std::size_t>(size)};
    return scene::one_line(line.substr(0, line.find('\n')));
}

/// Opens the file and locks it.
/// @throws  as `RunLock` does.
int open_locked(const std::filesystem::path& folder, const std::filesystem::path& path)
{
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, lock_mode);
    if (descriptor < 0) {
        fail(path, "open", errno);
    }
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        const int code = errno;
        const std::string who = code == EWOULDBLOCK ? holder(descriptor) : "";
        ::close(descriptor);
        if (code != EWOULDBLOCK) {
            fail(path, "flock", code);
        }
        throw scene::InputError(fmt::format("{}: another process is writing here ({}): wait for "
                                            "it, or name another folder",
                                            scene::one_line(folder.string()), who));
    }
    return descriptor;
}

/// Whether that is still the file: its last owner may have removed it before it was locked here.
bool is_file_at(const std::filesystem::path& path, int descriptor)
{
    struct stat there {};
    struct stat here {};
    return ::stat(path.c_str(), &there) == 0 && ::fstat(descriptor, &here) == 0 &&
           there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

} // namespace

RunLock::RunLock(const std::filesystem::path& folder) : path_{folder / "lock"}
{
    make_folder(folder);
    descriptor_ = open_locked(folder, path_);
    constexpr int most_tries = 100; // a file system may not know its own files again
    for (int i = 0; i < most_tries && !is_file_at(path_, descriptor_); ++i) {
        ::close(std::exchange(descriptor_, -1));
        descriptor_ = open_locked(folder, path_);
    }
    const std::string text = description_of_this_process();
    // The lock is held whether its text can be written or not.
    if (::ftruncate(descriptor_, 0) == 0) {
        [[maybe_unused]] const ssize_t written = ::pwrite(descriptor_, text.data(), text.size(), 0);
    }
    remove_leftovers(folder);
}

RunLock::~RunLock()
{
    // While it is locked: whoever opened it before finds out that it is no longer the one.
    ::unlink(path_.c_str());
    ::close(descriptor_);
}

} // namespace gnomon::store
