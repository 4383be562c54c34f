#pragma once

#include <string>
#include <vector>

namespace gnomon::store {

/// The words as a POSIX shell reads them back.
[[nodiscard]] std::string shell_text(const std::vector<std::string>& words);

} // namespace gnomon::store
