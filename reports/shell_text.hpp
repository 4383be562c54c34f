#pragma once

#include <string>
#include <vector>

namespace gnomon::reports {

/// The words as a POSIX shell reads them back.
[[nodiscard]] std::string shell_text(const std::vector<std::string>& words);

} // namespace gnomon::reports
