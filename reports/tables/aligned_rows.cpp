#include "reports/tables/aligned_rows.hpp"

#include "reports/text/text.hpp"

#include <algorithm>
#include <cstddef>

namespace gnomon::reports {

std::string aligned_rows(const std::vector<std::vector<std::string>>& rows)
{
    if (rows.size() < 2) {
        return {};
    }
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], text_columns(row[i]) + 2);
        }
    }
    std::string text = "\n";
    for (const auto& row : rows) {
        std::string line = "  ";
        for (std::size_t i = 0; i < row.size(); ++i) {
            line += pad_right(row[i], widths[i]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

} // namespace gnomon::reports
