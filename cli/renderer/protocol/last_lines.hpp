#pragma once

#include <string>

namespace gnomon::cli {

/// The end of what a program complained about, on one line of at most some 300 bytes. Indented
/// lines, which are stack traces and quoted code, are left out where there are others.
/// @param complaints  lines; the first may be cut.
[[nodiscard]] std::string last_lines(const std::string& complaints);

} // namespace gnomon::cli
