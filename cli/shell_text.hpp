#pragma once

#include <string>
#include <vector>

namespace gnomon::cli {

/// The words as a POSIX shell reads them back.
[[nodiscard]] std::string shell_text(const std::vector<std::string>& words);

} // namespace gnomon::cli
