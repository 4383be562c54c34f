#pragma once

#include <string_view>

namespace gnomon::cli {

/// Writes to stdout and flushes.
/// @throws scene::EnvironmentError  if the bytes cannot be written, e.g. on a full disk.
void print(std::string_view text);

} // namespace gnomon::cli
