#pragma once

#include "scene/import/scene_file.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace gnomon::scene {

/// Immutable bytes: a sealed memory file, mapped.
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

/// Inside the child: the time and memory allowed for the files opened so far.
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
    std::uint64_t base_memory_bytes_; ///< address space at the start
    std::uint64_t opened_bytes_ = 0;
};

/// Runs `work` in a child process that may crash, hang or exhaust its limits. Returns the bytes
/// that it wrote to its descriptor.
///
/// A small file gets 5 s of CPU time, 8 s of wall-clock time and 1 GiB; every 4 MB opened add 2 s,
/// 1 s and 1 GB, up to `limits`. Valid meshes are read at 30 MB/s and need 12 bytes of memory per
/// byte. A child that timed out while waiting is retried once.
/// @param label  begins the error message: the scene file's name.
/// @throws InputError        if the child crashed, hung or exceeded a limit.
/// @throws EnvironmentError  if no process or memory file can be created.
[[nodiscard]] SealedBytes run_in_child(const std::string& label, const ImportLimits& limits,
                                       const std::function<void(int, ImportAllowance&)>& work);

} // namespace gnomon::scene
