#pragma once

#include "scene/job.hpp"

#include <cstdint>

namespace gnomon::cli {

/// Memory that new work may take [bytes]: MemAvailable, or what `ulimit -v` or the control groups
/// leave if that is less; 0 if unknown.
[[nodiscard]] std::uint64_t available_memory_bytes();

/// Memory that an image and a shadow map of the job's sizes take, on the GPU and off it [bytes].
[[nodiscard]] std::uint64_t needed_memory_bytes(const scene::Job& job);

/// @throws scene::InputError  if the job needs more than is available; before any of it is taken.
void require_memory(const scene::Job& job);

} // namespace gnomon::cli
