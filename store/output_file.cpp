#include "store/output_file.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
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

/// `temporary_target` parses this name.
std::string temporary_name(const std::filesystem::path& path, pid_t process, unsigned serial)
{
    return fmt::format(".{}.{}-{}.tmp", path.filename().string(), process, serial);
}

/// Removes a suffix of one or more digits.
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

/// The target of a symbolic link; the path itself if it is not a link, or a broken one.
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

/// Whether fsync failed because a pipe, device or network file system does not support it.
bool is_unsupported(int code)
{
    return code == EINVAL || code == ENOTSUP || code == EROFS;
}

std::atomic_flag temporaries_lock;     ///< guards the list and its files
OutputFile* first_temporary = nullptr; ///< list of files with a temporary file

void lock_temporaries() noexcept
{
    while (temporaries_lock.test_and_set(std::memory_order_acquire)) {
    }
}

/// Locks the list of temporary files. Blocks signals meanwhile, because their handler locks it too.
class TemporariesGuard {
public:
    TemporariesGuard()
    {
        sigset_t all;
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_SETMASK, &all, &before_);
        lock_temporaries();
    }
    TemporariesGuard(const TemporariesGuard&) = delete;
    TemporariesGuard& operator=(const TemporariesGuard&) = delete;
    ~TemporariesGuard()
    {
        temporaries_lock.clear(std::memory_order_release);
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }

private:
    sigset_t before_{};
};

enum class ExtensionRule : std::uint8_t {
    chooses_format, ///< required; decides the format
    own_or_none,
    none_of_others,
};

struct OutputFormat {
    OutputKind kind;
    std::string_view noun;
    std::array<std::string_view, 3> extensions;
    ExtensionRule rule;
};

constexpr auto output_formats = std::to_array<OutputFormat>({
    {OutputKind::picture, "a picture", {".png"}, ExtensionRule::own_or_none},
    {OutputKind::layers, "an image of numbers", {".exr"}, ExtensionRule::own_or_none},
    {OutputKind::plot, "a plot", {".svg", ".png"}, ExtensionRule::chooses_format},
    {OutputKind::figure, "a figure", {".pdf", ".svg", ".png"}, ExtensionRule::chooses_format},
    {OutputKind::csv, "a table", {".csv"}, ExtensionRule::none_of_others},
    {OutputKind::junit, "a JUnit report", {".xml"}, ExtensionRule::none_of_others},
    {OutputKind::baseline, "a baseline", {".json"}, ExtensionRule::none_of_others},
    {OutputKind::job, "a job file", {".toml"}, ExtensionRule::own_or_none},
});

/// Extensions of other programs' files, which a text must not replace by mistake.
constexpr auto foreign_extensions = std::to_array<std::string_view>(
    {".jpg", ".jpeg", ".gif", ".tif", ".tiff", ".gltf", ".glb", ".obj", ".ply", ".sqlite"});

bool has_extension(const OutputFormat& kind, std::string_view extension)
{
    return !extension.empty() &&
           std::ranges::find(kind.extensions, extension) != kind.extensions.end();
}

bool belongs_to_others(std::string_view extension)
{
    return std::ranges::find(foreign_extensions, extension) != foreign_extensions.end() ||
           std::ranges::any_of(output_formats, [&](const OutputFormat& kind) {
               return has_extension(kind, extension);
           });
}

bool fits(const OutputFormat& kind, std::string_view extension)
{
    if (has_extension(kind, extension)) {
        return true;
    }
    switch (kind.rule) {
    case ExtensionRule::chooses_format:
        return false;
    case ExtensionRule::own_or_none:
        return extension.empty();
    case ExtensionRule::none_of_others:
        return !belongs_to_others(extension);
    }
    return false; // unreachable: the switch names every enumerator
}

/// ".pdf, .svg or .png"
std::string extensions_text(const OutputFormat& kind)
{
    std::string text{kind.extensions.front()};
    for (std::size_t i = 1; i < kind.extensions.size() && !kind.extensions[i].empty(); ++i) {
        const bool is_last = i + 1 == kind.extensions.size() || kind.extensions[i + 1].empty();
        text += fmt::format("{}{}", is_last ? " or " : ", ", kind.extensions[i]);
    }
    return text;
}

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

/// Removes this file from the list, which the caller has locked.
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

/// Makes the rename durable.
void OutputFile::sync_folder() const
{
    const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) {
        return; // the folder is writable, but not readable
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
    lock_temporaries(); // never unlocked: no file may appear before the process ends
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

void make_folder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw scene::EnvironmentError(
            fmt::format("{}: the folder cannot be created: {}; name another",
                        scene::one_line(folder.string()), error.message()));
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

void require_output_name(const std::filesystem::path& path, OutputKind kind)
{
    const auto* const found = std::ranges::find(output_formats, kind, &OutputFormat::kind);
    const std::string extension = path.extension().string();
    if (!fits(*found, extension)) {
        throw scene::InputError(fmt::format("{}: {} is written as {}; name it so",
                                            scene::one_line(path.string()), found->noun,
                                            extensions_text(*found)));
    }
}

} // namespace gnomon::store
