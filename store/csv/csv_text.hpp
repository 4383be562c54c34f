#pragma once

#include <string>
#include <string_view>

namespace gnomon::store {

/// The text with everything replaced that a reader of a file could stumble over: bytes that are no
/// UTF-8, and control characters other than tabs and ends of lines, become U+FFFD.
[[nodiscard]] std::string readable_text(std::string_view text);

/// Appends a number as the shortest text that reads back as the same double.
void append_csv_number(std::string& out, double number);

/// Appends a text as a cell of RFC 4180: in double quotes where it needs them.
///
/// A text that a spreadsheet would take for a formula (it begins with = + - @, a tab or a carriage
/// return) gets a single quote in front. Else it is `readable_text`.
void append_csv_text(std::string& out, std::string_view text);

} // namespace gnomon::store
