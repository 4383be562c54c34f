#pragma once

#include <string>
#include <vector>

namespace gnomon::store {

/// Joins words, quoted for a POSIX shell where needed.
[[nodiscard]] std::string shell_text(const std::vector<std::string>& words);

} // namespace gnomon::store
