#pragma once

#include "scene/job/file.hpp"

#include <cstdint>
#include <span>

namespace gnomon::api {

/// Memory that new work may take [bytes]: MemAvailable, or what `ulimit -v` or the control groups
/// leave if that is less; 0 if unknown.
[[nodiscard]] std::uint64_t available_memory_bytes();

/// Memory that an image and a shadow map of the job's sizes take, on the GPU and off it [bytes].
[[nodiscard]] std::uint64_t needed_memory_bytes(const scene::Job& job);

/// Lets memory that is freed stay with a small process, for what is allocated next. GL by software
/// makes a texture for every shadow map, and the system clears what it hands out page by page: of a
/// long sweep that took a tenth. A large process gives back what it frees, also after this. Does
/// nothing where the C library is not glibc.
class FreedMemoryKeeper {
public:
    FreedMemoryKeeper() = default;
    FreedMemoryKeeper(const FreedMemoryKeeper&) = delete;
    FreedMemoryKeeper& operator=(const FreedMemoryKeeper&) = delete;
    /// Gives back what it kept.
    ~FreedMemoryKeeper();

    /// Keeps freed memory from now on if the process will be small: if what it holds and what it
    /// needs is at most 0.6 GiB together. Else gives it back from now on.
    void keep(std::uint64_t needed_bytes);
    /// Gives everything back, and keeps no more, once the process holds more than 1.2 GiB. To be
    /// called now and then.
    void limit();

private:
    bool keeps_ = false;
};

/// @throws scene::InputError  if the job needs more than is available; before any of it is taken.
void require_memory(const scene::Job& job);
/// The same of the jobs of several lights, whose images are kept side by side.
/// @param jobs  at least one.
void require_memory(std::span<const scene::LightJob> jobs);

} // namespace gnomon::api
