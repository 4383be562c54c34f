#include "store/run_folder/run_lock.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/csv/run_csv.hpp"
#include "store/output_file.hpp"
#include "store/run_folder/pixels.hpp"

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
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::store {

namespace {

namespace fs = std::filesystem;

bool is_csv_name(std::string_view name)
{
    return std::find(run_csv_names.begin(), run_csv_names.end(), name) != run_csv_names.end();
}

std::vector<fs::path> files_in(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry{folder, error}; !error && entry != fs::directory_iterator{};
         entry.increment(error)) {
        std::error_code unknown;
        if (entry->symlink_status(unknown).type() == fs::file_type::regular) {
            files.push_back(entry->path());
        }
    }
    return files;
}

/// Removes the temporary files of the folder's own files.
void remove_temporaries(const fs::path& folder, bool (*is_own)(std::string_view name))
{
    for (const fs::path& file : files_in(folder)) {
        const std::string name = file.filename().string();
        if (is_own(temporary_target(name))) {
            std::error_code error;
            fs::remove(file, error);
        }
    }
}

constexpr mode_t lock_mode = 0666; ///< before the umask

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view call, int code)
{
    throw scene::EnvironmentError(
        fmt::format("cannot lock {}: {}: {} (errno {}); choose a writable folder, on a "
                    "disk that supports locks",
                    scene::one_line(path.string()), call,
                    std::error_code{code, std::generic_category()}.message(), code));
}

/// The command line of this process, its words separated by spaces.
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

/// The holder's description in the file, which may not be written yet.
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

/// Whether the locked file is still at the path. Its last owner may have removed it.
bool is_file_at(const std::filesystem::path& path, int descriptor)
{
    struct stat there {};
    struct stat here {};
    return ::stat(path.c_str(), &there) == 0 && ::fstat(descriptor, &here) == 0 &&
           there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

} // namespace

void remove_leftovers(const fs::path& folder)
{
    remove_temporaries(folder, is_csv_name);
    remove_temporaries(folder / "pixels", is_pixels_name);
}

RunLock::RunLock(const std::filesystem::path& folder) : path_{folder / "lock"}
{
    make_folder(folder);
    descriptor_ = open_locked(folder, path_);
    constexpr int most_tries = 100; // some file systems never report equal inodes
    for (int i = 0; i < most_tries && !is_file_at(path_, descriptor_); ++i) {
        ::close(std::exchange(descriptor_, -1));
        descriptor_ = open_locked(folder, path_);
    }
    const std::string text = description_of_this_process();
    // Errors are ignored: the lock holds without its text.
    if (::ftruncate(descriptor_, 0) == 0) {
        [[maybe_unused]] const ssize_t written = ::pwrite(descriptor_, text.data(), text.size(), 0);
    }
    remove_leftovers(folder);
}

RunLock::~RunLock()
{
    // Unlink while locked, so that a process that opened the file earlier notices (`is_file_at`).
    ::unlink(path_.c_str());
    ::close(descriptor_);
}

} // namespace gnomon::store
