#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace gnomon::store {

/// A file that appears whole or not at all.
///
/// Bytes go to a temporary file in the same folder; `commit` flushes it to the disk and renames it
/// over the path. Without `commit` the destructor removes the temporary file, and whatever stood at
/// the path stays untouched. A device or a pipe (/dev/stdout) cannot be renamed over: it is written
/// directly. A symbolic link is followed.
/// A signal handler that ends the process calls `abandon_output_files` first.
class OutputFile {
public:
    /// @throws scene::EnvironmentError  if the path is a folder or its folder cannot be written.
    explicit OutputFile(const std::filesystem::path& path);
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
    void rename_temporary();
    void forget_temporary();
    void sync_folder() const;
    friend void abandon_output_files() noexcept;

    std::filesystem::path path_;
    std::filesystem::path temporary_; ///< empty: the path is written directly, or it is committed
    int descriptor_ = -1;
    OutputFile* next_ = nullptr; ///< of those that have a temporary file
};

/// The file name over which `OutputFile` would have renamed a temporary file of that name, in any
/// process: "a.csv" for ".a.csv.4711-0.tmp". Empty if it gives no file such a name.
[[nodiscard]] std::string_view temporary_target(std::string_view name);

/// Removes the temporary file of every `OutputFile`, and lets none make or rename another: for a
/// signal handler, in whatever thread, that ends the process next. Async-signal-safe.
void abandon_output_files() noexcept;

/// Fails where `OutputFile` would; leaves a pipe alone, whose reader would take this for the end.
/// @throws scene::EnvironmentError
void require_writable(const std::filesystem::path& path);

/// Writes the whole file, atomically.
/// @throws scene::EnvironmentError  as `OutputFile` does.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

} // namespace gnomon::store
