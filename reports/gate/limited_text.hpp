#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon::reports {

/// The bytes of a file that people may have written.
/// @param kind  What it should be, for messages: "baseline".
/// @throws scene::InputError  if it cannot be read, is a folder, or is longer than `most_bytes`.
[[nodiscard]] std::string read_limited_text(const std::filesystem::path& path,
                                            std::uint64_t most_bytes, const std::string& kind);

} // namespace gnomon::reports
