#pragma once

#include <filesystem>
#include <string>

namespace gnomon::scene {

/// Reads a text that people write: a job, a case.
/// @param name  how messages speak of the file.
/// @param kind  what it should be, "job file".
/// @throws InputError  if it is a folder, cannot be opened or read, or is longer than any such
/// text.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path, const std::string& name,
                                         const std::string& kind);

} // namespace gnomon::scene
