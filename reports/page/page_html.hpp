#pragma once

#include "reports/page/report_options.hpp"
#include "reports/page/run_overview.hpp"
#include "store/json.hpp"

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// Escapes a text for HTML content or a quoted attribute.
[[nodiscard]] std::string escaped(std::string_view text);

/// A right-aligned table cell with a number.
[[nodiscard]] std::string number_cell(std::string_view text);

[[nodiscard]] std::string row_heading(std::string_view text);

/// Opens a table up to its first row; `table_end` closes it.
/// @param columns  The first is the row heading, the others are numbers.
[[nodiscard]] std::string table_head(std::string_view caption,
                                     std::span<const std::string_view> columns);
[[nodiscard]] std::string table_head(std::string_view caption,
                                     std::initializer_list<std::string_view> columns);

inline constexpr std::string_view table_end = "</tbody></table></div>\n";

/// The whole page: a head whose Content-Security-Policy allows only its own style and scripts, the
/// body, data and scripts.
/// @param blocks  the packed texts "b0", "b1", ….
[[nodiscard]] std::string whole_page(std::string_view title, std::string_view body,
                                     const store::Json& data, std::span<const std::string> blocks);

/// Errors by object in HTML, most errors first, or why they are unknown.
/// @param detail  The output of `compare --json`; null if it was not kept.
[[nodiscard]] std::string objects_table(const store::Json& detail);

/// Errors by map, and the range of each cascade; empty for a light with one map.
[[nodiscard]] std::string maps_table(const store::Json& detail, std::string_view unit);

/// The part of a page that works without JavaScript: from the header to the end of main.
/// @param pictures  data: URLs of the figures, in their order.
[[nodiscard]] std::string page_body(const store::RunReader& run, const RunOverview& overview,
                                    const ReportOptions& options,
                                    std::span<const std::string> pictures);

} // namespace gnomon::reports
