#pragma once

#include "scene/import/scene_file.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace gnomon::scene {

/// Read-only bytes that nobody can change any more: a sealed memory file, mapped.
class SealedBytes {
public:
    SealedBytes() = default;
    /// Seals and maps `fd`. @throws EnvironmentError  if it cannot be sealed or mapped.
    explicit SealedBytes(int fd);
    SealedBytes(SealedBytes&& other) noexcept;
    SealedBytes& operator=(SealedBytes&& other) noexcept;
    ~SealedBytes();

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::span<const std::byte> bytes_;
};

/// Inside the child: what the files opened so far entitle the work to.
class ImportAllowance {
public:
    explicit ImportAllowance(const ImportLimits& limits);
    /// Adds the time and memory that a file of this size may need, within the limits.
    void add_file(std::uint64_t byte_count);

private:
    void apply() const;
    void set_alarm() const;

    ImportLimits limits_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::uint64_t base_memory_bytes_; ///< address space that the process began with
    std::uint64_t opened_bytes_ = 0;
};

/// Runs `work` in a child process that may crash, hang or exhaust its limits, and returns what it
/// wrote to the descriptor that it was given.
///
/// A small file gets 5 s of computing, 8 s by the clock and 1 GiB; every 4 MB opened add 2 s, 1 s
/// and 1 GB, up to `limits`. Sound meshes are read at 30 MB/s and take 12 bytes of memory a byte.
/// A child whose time ran out while it waited is replaced by another, once.
/// @param label  begins the error message: the scene file's name.
/// @throws InputError        if the child crashed, hung or exceeded a limit.
/// @throws EnvironmentError  if no process or memory file could be had.
[[nodiscard]] SealedBytes run_in_child(const std::string& label, const ImportLimits& limits,
                                       const std::function<void(int, ImportAllowance&)>& work);

} // namespace gnomon::scene
