#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace gnomon::store {

/// A file that appears complete or not at all.
///
/// Bytes go to a temporary file in the same folder; `commit` flushes it to the disk and renames it
/// to the path. Without `commit`, the destructor removes the temporary file, and an existing file
/// stays unchanged. A device or a pipe (/dev/stdout) is written directly. Symbolic links are
/// followed. A signal handler that ends the process calls `abandon_output_files` first.
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
    std::filesystem::path temporary_; ///< empty: written directly, or committed
    int descriptor_ = -1;
    OutputFile* next_ = nullptr; ///< in the list of files with a temporary file
};

/// The final name of a temporary file of any process: "a.csv" for ".a.csv.4711-0.tmp". Empty if the
/// name is not that of a temporary file.
[[nodiscard]] std::string_view temporary_target(std::string_view name);

/// Removes the temporary file of every `OutputFile`, and blocks new ones and renames. For a signal
/// handler, in any thread, that ends the process next. Async-signal-safe.
void abandon_output_files() noexcept;

/// Throws if `OutputFile` would. Does not open pipes: closing one would look like its end to the
/// reader.
/// @throws scene::EnvironmentError
void require_writable(const std::filesystem::path& path);

/// Creates a folder and those around it, unless it is there.
/// @throws scene::EnvironmentError  naming the folder.
void make_folder(const std::filesystem::path& folder);

/// Writes the whole file, atomically.
/// @throws scene::EnvironmentError  as `OutputFile` does.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// The content of an output file.
enum class OutputKind : std::uint8_t {
    picture,
    layers,
    plot,
    figure,
    csv,
    junit,
    baseline,
    job,
};

/// Checks that a file's extension fits its content. An image or job needs its own extension or none
/// (a device, a pipe). The extension of a plot or figure chooses the format. Other texts may have
/// any extension that does not belong to another format.
/// @throws scene::InputError  naming the path and the remedy.
void require_output_name(const std::filesystem::path& path, OutputKind kind);

} // namespace gnomon::store
