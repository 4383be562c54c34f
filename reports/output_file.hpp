#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace gnomon::reports {

/// A file that appears whole or not at all.
///
/// Bytes go to a temporary file in the same folder; `commit` flushes it to the disk and renames it
/// over the path. Without `commit` the destructor removes the temporary file, and whatever stood at
/// the path stays untouched. A device or a pipe (/dev/stdout) cannot be renamed over: it is written
/// directly. A symbolic link is followed.
class OutputFile {
public:
    /// @throws scene::EnvironmentError  if the path is a folder or its folder cannot be written.
    explicit OutputFile(std::filesystem::path path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    /// @throws scene::EnvironmentError  e.g. if the disk is full.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    /// Makes the file appear; nothing can be written afterwards.
    /// @throws scene::EnvironmentError  if the bytes cannot be made durable.
    void commit();

private:
    void fail(std::string_view call, int code) const;
    void open_temporary();
    void sync_folder() const;

    std::filesystem::path path_;
    std::filesystem::path temporary_; ///< empty: the path is written directly, or it is committed
    int descriptor_ = -1;
};

/// Writes the whole file, atomically.
/// @throws scene::EnvironmentError  as `OutputFile` does.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

} // namespace gnomon::reports
