#include "store/csv/csv_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

namespace gnomon::store {

namespace {

constexpr std::string_view replacement = "\uFFFD";

bool is_printable_ascii(char c)
{
    return c >= 0x20 && c < 0x7F;
}

bool is_kept_control(char c)
{
    return c == '\t' || c == '\n' || c == '\r';
}

/// The length of the first character [bytes]; 0 if it is not valid UTF-8.
/// Source: Unicode 15, table 3-7.
std::size_t utf8_length(std::string_view text)
{
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
    const unsigned lead = byte(0);
    if (lead >= 0xC2 && lead <= 0xDF) {
        return continues(1) ? 2 : 0;
    }
    if (lead >= 0xE0 && lead <= 0xEF) {
        const unsigned lowest = lead == 0xE0 ? 0xA0 : 0x80;
        const unsigned highest = lead == 0xED ? 0x9F : 0xBF;
        return byte(1) >= lowest && byte(1) <= highest && continues(2) ? 3 : 0;
    }
    if (lead >= 0xF0 && lead <= 0xF4) {
        const unsigned lowest = lead == 0xF0 ? 0x90 : 0x80;
        const unsigned highest = lead == 0xF4 ? 0x8F : 0xBF;
        return byte(1) >= lowest && byte(1) <= highest && continues(2) && continues(3) ? 4 : 0;
    }
    return 0;
}

void append_quoted(std::string& out, std::string_view text)
{
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char c : text) {
        out += c;
        if (c == '"') {
            out += c;
        }
    }
    out += '"';
}

bool is_alphanumeric(char c)
{
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// Appends rows of the statement.
/// @param most_bytes  stops after the row that reaches this size.
/// @return  False after the last row.
bool append_rows(std::string& out, sqlite::Statement& statement, std::size_t most_bytes)
{
    const int columns = statement.column_count();
    while (out.size() < most_bytes) {
        if (!statement.step()) {
            return false;
        }
        append_cells(out, statement, 0, columns);
        out += '\n';
    }
    return true;
}

} // namespace

std::string readable_text(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        const char c = text.front();
        const bool is_ascii = is_printable_ascii(c) || is_kept_control(c);
        const std::size_t length = is_ascii ? 1 : utf8_length(text);
        result += length > 0 ? text.substr(0, length) : replacement;
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

void append_csv_number(std::string& out, double number)
{
    std::array<char, 32> text{}; // the longest is "-2.2250738585072014e-308"
    const char* const end = fmt::format_to(text.data(), "{}", number);
    out.append(text.data(), static_cast<std::size_t>(end - text.data()));
}

void append_csv_text(std::string& out, std::string_view text)
{
    // The fast path for ids and plain names, which are most texts.
    if (std::all_of(text.begin(), text.end(), is_alphanumeric)) {
        out += text;
        return;
    }
    constexpr std::string_view formula_starts = "=+-@\t\r";
    std::string shown = readable_text(text);
    if (!shown.empty() && formula_starts.find(shown.front()) != std::string_view::npos) {
        shown.insert(shown.begin(), '\'');
    }
    append_quoted(out, shown);
}

std::string cell_text(const sqlite::ValueView& value)
{
    std::string text;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        text = fmt::format("{}", *integer);
    } else if (const auto* real = std::get_if<double>(&value)) {
        append_csv_number(text, *real);
    } else if (const auto* words = std::get_if<std::string_view>(&value)) {
        text = *words;
    }
    return text;
}

void append_cell(std::string& out, const sqlite::ValueView& value)
{
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        const fmt::format_int text{*integer};
        out.append(text.data(), text.size());
    } else if (const auto* real = std::get_if<double>(&value)) {
        append_csv_number(out, *real);
    } else if (const auto* text = std::get_if<std::string_view>(&value)) {
        append_csv_text(out, *text);
    }
}

void append_cells(std::string& out, const sqlite::Statement& statement, int first, int count)
{
    for (int i = first; i < first + count; ++i) {
        if (i > first) {
            out += ',';
        }
        append_cell(out, statement.value(i));
    }
}

void CsvFile::write_header(const sqlite::Statement& statement)
{
    for (int i = 0; i < statement.column_count(); ++i) {
        pending_ += i == 0 ? "" : ",";
        append_csv_text(pending_, statement.column_name(i));
    }
    pending_ += '\n';
}

void CsvFile::write_rows(sqlite::Statement& statement)
{
    while (append_rows(pending_, statement, block_bytes)) {
        flush();
    }
}

void CsvFile::write_text(std::string_view rows)
{
    flush();
    file_.write(rows);
}

void CsvFile::commit()
{
    flush();
    file_.commit();
}

void CsvFile::flush()
{
    file_.write(pending_);
    pending_.clear();
}

} // namespace gnomon::store
