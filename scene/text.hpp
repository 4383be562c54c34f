#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// The text with control characters replaced by '?', so that a message stays one line.
[[nodiscard]] std::string one_line(std::string_view text);

/// The text with ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// A count with its thousands grouped: "1,048,578".
[[nodiscard]] std::string grouped(std::uint64_t count);

/// Counts of `count` things: "1 triangle", "2,000 triangles".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view noun);

/// The candidate with the fewest edits to `word`, the first among equals; empty without candidates.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& candidates);
/// As `nearest_word`, but empty if more than half of the longer word's letters differ.
[[nodiscard]] std::string similar_word(std::string_view word,
                                       const std::vector<std::string>& candidates);

/// The default limit; job files have a few kilobytes.
inline constexpr std::uint64_t most_text_bytes = 16U << 20U;

/// Reads a file that people may have written: a job, a case, a baseline.
/// @param name  the file's name in messages.
/// @param kind  what it should be, "job file".
/// @throws InputError  if it is a folder, cannot be opened or read, or is longer than `most_bytes`.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path, const std::string& name,
                                         const std::string& kind,
                                         std::uint64_t most_bytes = most_text_bytes);

} // namespace gnomon::scene
