#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon::scene {

/// A job file with every key, axis and case that anybody needs has a few kilobytes.
inline constexpr std::uint64_t most_text_bytes = 16U << 20U;

/// The bytes of a file that people may have written: a job, a case, a baseline.
/// @param name  how messages speak of the file.
/// @param kind  what it should be, "job file".
/// @throws InputError  if it is a folder, cannot be opened or read, or is longer than `most_bytes`.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path, const std::string& name,
                                         const std::string& kind,
                                         std::uint64_t most_bytes = most_text_bytes);

} // namespace gnomon::scene
