#pragma once

#include <string>
#include <vector>

namespace gnomon::reports {

/// Rows of equally many cells in columns, indented and after an empty line; nothing if there is
/// but a heading.
[[nodiscard]] std::string aligned_rows(const std::vector<std::vector<std::string>>& rows);

} // namespace gnomon::reports
