#include "store/output_file.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <string>
#include <system_error>
#include <utility>

namespace gnomon::store {

namespace {

constexpr mode_t default_mode = 0666; ///< before the umask

std::filesystem::path folder_of(const std::filesystem::path& path)
{
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path{"."};
}

std::string remedy(const std::filesystem::path& path, int code)
{
    switch (code) {
    case ENOENT:
    case ENOTDIR:
        return fmt::format("create the folder {} first", folder_of(path).string());
    case EACCES:
    case EPERM:
    case EROFS:
        return fmt::format("choose a folder that may be written, {} may not",
                           folder_of(path).string());
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
        return "make room, or choose another disk";
    case EISDIR:
        return "name a file in that folder";
    default:
        return "choose another path";
    }
}

/// `temporary_target` reads it.
std::string temporary_name(const std::filesystem::path& path, pid_t process, unsigned serial)
{
    return fmt::format(".{}.{}-{}.tmp", path.filename().string(), process, serial);
}

/// Takes a suffix of one or more digits off.
bool drop_digits(std::string_view& text)
{
    const std::size_t size = text.size();
    while (!text.empty() && text.back() >= '0' && text.back() <= '9') {
        text.remove_suffix(1);
    }
    return text.size() < size;
}

bool drop_suffix(std::string_view& text, std::string_view suffix)
{
    const bool has_suffix = text.ends_with(suffix);
    text.remove_suffix(has_suffix ? suffix.size() : 0);
    return has_suffix;
}

/// The file that a symbolic link names; the path itself if it is no link or leads nowhere.
std::filesystem::path follow_link(const std::filesystem::path& path)
{
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error)) {
        return path;
    }
    std::filesystem::path target = std::filesystem::canonical(path, error);
    return error ? path : target;
}

bool write_all(int descriptor, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) {
            return false;
        }
        if (written > 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
    }
    return true;
}

/// Pipes, devices and some network file systems have nothing to flush and say so.
bool is_unsupported(int code)
{
    return code == EINVAL || code == ENOTSUP || code == EROFS;
}

std::atomic_flag temporaries_taken;    ///< guards the list, and the files that it names
OutputFile* first_temporary = nullptr; ///< of the list of those that have a temporary file

void take_temporaries() noexcept
{
    while (temporaries_taken.test_and_set(std::memory_order_acquire)) {
    }
}

/// Holds the list of temporary files. Signals wait meanwhile, for their handler takes it too.
class TemporariesGuard {
public:
    TemporariesGuard()
    {
        sigset_t all;
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_SETMASK, &all, &before_);
        take_temporaries();
    }
    TemporariesGuard(const TemporariesGuard&) = delete;
    TemporariesGuard& operator=(const TemporariesGuard&) = delete;
    ~TemporariesGuard()
    {
        temporaries_taken.clear(std::memory_order_release);
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }

private:
    sigset_t before_{};
};

} // namespace

OutputFile::OutputFile(const std::filesystem::path& path) : path_{follow_link(path)}
{
    struct stat status {};
    const bool exists = ::stat(path_.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) {
        fail("open", EISDIR);
    }
    if (exists && !S_ISREG(status.st_mode)) {
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) {
            fail("open", errno);
        }
        return;
    }
    open_temporary();
}

OutputFile::~OutputFile()
{
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
    if (!temporary_.empty()) {
        const TemporariesGuard guard;
        ::unlink(temporary_.c_str());
        forget_temporary();
    }
}

void OutputFile::open_temporary()
{
    static std::atomic<unsigned> serial{0};
    std::filesystem::path candidate;
    const TemporariesGuard guard;
    do {
        candidate = folder_of(path_) / temporary_name(path_, ::getpid(), serial++);
        descriptor_ =
            ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, default_mode);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) {
        fail("open", errno);
    }
    temporary_ = std::move(candidate);
    next_ = std::exchange(first_temporary, this);
}

/// Takes this file out of the list; the caller holds it.
void OutputFile::forget_temporary()
{
    OutputFile** link = &first_temporary;
    while (*link != this) {
        link = &(*link)->next_;
    }
    *link = next_;
    temporary_.clear();
}

void OutputFile::rename_temporary()
{
    const TemporariesGuard guard;
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
        fail("rename", errno);
    }
    forget_temporary();
}

void OutputFile::write(std::span<const std::byte> bytes)
{
    assert(descriptor_ >= 0);
    if (!write_all(descriptor_, bytes)) {
        fail("write", errno);
    }
}

void OutputFile::write(std::string_view text)
{
    write(std::as_bytes(std::span<const char>{text}));
}

void OutputFile::commit()
{
    assert(descriptor_ >= 0);
    if (::fsync(descriptor_) != 0 && !is_unsupported(errno)) {
        fail("fsync", errno);
    }
    if (::close(std::exchange(descriptor_, -1)) != 0) {
        fail("close", errno);
    }
    if (temporary_.empty()) {
        return;
    }
    rename_temporary();
    sync_folder();
}

/// The rename itself lasts only once the folder is on the disk.
void OutputFile::sync_folder() const
{
    const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) {
        return; // a folder that may be written but not read cannot be flushed
    }
    const int code = ::fsync(folder) == 0 ? 0 : errno;
    ::close(folder);
    if (code != 0 && !is_unsupported(code)) {
        fail("fsync", code);
    }
}

void OutputFile::fail(std::string_view call, int code) const
{
    throw scene::EnvironmentError(fmt::format(
        "cannot write {}: {}: {} (errno {}); {}", path_.string(), call,
        std::error_code{code, std::generic_category()}.message(), code, remedy(path_, code)));
}

std::string_view temporary_target(std::string_view name)
{
    const bool is_temporary = name.starts_with('.') && drop_suffix(name, ".tmp") &&
                              drop_digits(name) && drop_suffix(name, "-") && drop_digits(name) &&
                              drop_suffix(name, ".") && name.size() > 1;
    return is_temporary ? name.substr(1) : std::string_view{};
}

void abandon_output_files() noexcept
{
    take_temporaries(); // and keeps them: nothing may appear between this and the process's end
    for (const OutputFile* file = first_temporary; file != nullptr; file = file->next_) {
        ::unlink(file->temporary_.c_str());
    }
}

void require_writable(const std::filesystem::path& path)
{
    std::error_code unreachable;
    if (!std::filesystem::is_fifo(path, unreachable)) {
        const OutputFile probe{path};
    }
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes)
{
    OutputFile file{path};
    file.write(bytes);
    file.commit();
}

void write_file(const std::filesystem::path& path, std::string_view text)
{
    write_file(path, std::as_bytes(std::span<const char>{text}));
}

} // namespace gnomon::store
