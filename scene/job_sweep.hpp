#pragma once

#include "scene/job_file.hpp"
#include "scene/job_toml.hpp"

#include <string>

namespace gnomon::scene {

/// Reads `[sweep]`: its axes, expanded and each value held against its key, and how to combine
/// them.
/// @throws InputError  "file:line: [sweep] key = value: …".
[[nodiscard]] Sweep read_sweep(const TomlMember& member, const std::string& file);

} // namespace gnomon::scene
