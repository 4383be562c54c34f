#pragma once

#include "store/json.hpp"

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// A text in HTML, also within quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// A cell of numbers, which a reader compares down a column.
[[nodiscard]] std::string number_cell(std::string_view text);

[[nodiscard]] std::string row_heading(std::string_view text);

/// A table up to its first row; `table_end` ends it.
/// @param columns  The first one heads the rows, the others have numbers.
[[nodiscard]] std::string table_head(std::string_view caption,
                                     std::span<const std::string_view> columns);
[[nodiscard]] std::string table_head(std::string_view caption,
                                     std::initializer_list<std::string_view> columns);

inline constexpr std::string_view table_end = "</tbody></table></div>\n";

/// The whole page: a head with a Content-Security-Policy that names its style and scripts alone,
/// the body, data and scripts.
/// @param blocks  the packed texts "b0", "b1", ….
[[nodiscard]] std::string whole_page(std::string_view title, std::string_view body,
                                     const store::Json& data, std::span<const std::string> blocks);

} // namespace gnomon::reports
