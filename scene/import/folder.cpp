#include "scene/import/folder.hpp"

#include <assimp/IOStream.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <string_view>
#include <utility>

namespace gnomon::scene {

namespace {

/// A regular file, open for reading, whose first bytes may be replaced.
class ReadOnlyFile final : public Assimp::IOStream {
public:
    /// @param byte_count  of the file itself; at least as many as the head replaces.
    ReadOnlyFile(int fd, std::uint64_t byte_count, FileHead head)
        : fd_{fd},
          byte_count_{byte_count - head.replaced_bytes + head.text.size()},
          head_{std::move(head)}
    {
    }
    ReadOnlyFile(const ReadOnlyFile&) = delete;
    ReadOnlyFile& operator=(const ReadOnlyFile&) = delete;
    ~ReadOnlyFile() override { ::close(fd_); }

    size_t Read(void* buffer, size_t size, size_t count) override
    {
        if (size == 0 || count > std::numeric_limits<size_t>::max() / size) {
            return 0;
        }
        auto* bytes = static_cast<char*>(buffer);
        size_t done = 0;
        if (position_ < head_.text.size()) {
            done = head_.text.copy(bytes, size * count, position_);
        }
        while (done < size * count) {
            const size_t behind_head = position_ + done - head_.text.size();
            const ssize_t got = ::pread(fd_, bytes + done, size * count - done,
                                        static_cast<off_t>(head_.replaced_bytes + behind_head));
            if (got <= 0) {
                break;
            }
            done += static_cast<size_t>(got);
        }
        position_ += done;
        return done / size;
    }
    size_t Write(const void*, size_t, size_t) override { return 0; }
    aiReturn Seek(size_t offset, aiOrigin origin) override
    {
        // Offsets are unsigned: a step back wraps around, as with the importer's own streams.
        const size_t base = origin == aiOrigin_SET   ? 0
                            : origin == aiOrigin_CUR ? position_
                                                     : byte_count_;
        const size_t target = base + offset;
        if (target > byte_count_) {
            return aiReturn_FAILURE;
        }
        position_ = target;
        return aiReturn_SUCCESS;
    }
    size_t Tell() const override { return position_; }
    size_t FileSize() const override { return byte_count_; }
    void Flush() override {}

private:
    int fd_;
    size_t byte_count_;
    FileHead head_;
    size_t position_ = 0;
};

std::string percent_decoded(std::string_view text)
{
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned code = 0;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(&text[i + 1], &text[i + 1] + 2, code, 16).ptr == &text[i + 1] + 2) {
            decoded += static_cast<char>(code);
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

} // namespace

ImportFolder::ImportFolder(std::filesystem::path scene_file,
                           std::function<void(std::uint64_t)> on_open)
    : scene_file_{std::move(scene_file)},
      folder_{std::filesystem::canonical(scene_file_.parent_path())},
      on_open_{std::move(on_open)}
{
}

bool ImportFolder::is_beneath(const std::filesystem::path& canonical) const
{
    const auto [folder_end, unused] =
        std::mismatch(folder_.begin(), folder_.end(), canonical.begin(), canonical.end());
    return folder_end == folder_.end();
}

std::optional<std::filesystem::path> ImportFolder::find(const char* name) const
{
    for (const std::filesystem::path wanted : {std::string{name}, percent_decoded(name)}) {
        if (wanted == scene_file_) {
            return scene_file_;
        }
        std::error_code error;
        const auto canonical = std::filesystem::canonical(wanted, error);
        if (error) {
            continue;
        }
        if (is_beneath(canonical)) {
            return canonical;
        }
        if (refused_name_.empty()) {
            refused_name_ = wanted.lexically_relative(scene_file_.parent_path()).string();
        }
    }
    return std::nullopt;
}

bool ImportFolder::Exists(const char* name) const
{
    return find(name).has_value();
}

Assimp::IOStream* ImportFolder::Open(const char* name, const char* mode)
{
    const auto path = find(name);
    if (!path || mode[0] != 'r') {
        return nullptr;
    }
    // Without O_NONBLOCK a pipe would hold the importer until somebody writes to it.
    const int fd = ::open(path->c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) {
        return nullptr;
    }
    struct stat facts {};
    if (::fstat(fd, &facts) != 0 || !S_ISREG(facts.st_mode)) {
        ::close(fd);
        return nullptr;
    }
    const auto byte_count = static_cast<std::uint64_t>(facts.st_size);
    on_open_(byte_count);
    const bool has_head = *path == scene_file_ && head_.replaced_bytes <= byte_count;
    return new ReadOnlyFile{fd, byte_count, has_head ? head_ : FileHead{}};
}

void ImportFolder::Close(Assimp::IOStream* stream)
{
    delete stream;
}

} // namespace gnomon::scene
