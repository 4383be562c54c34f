#include "store/csv/csv_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

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

/// How many bytes the character at the front has: 0 if it is no UTF-8.
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
    // Most texts are ids and plain names, and there are many.
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

} // namespace gnomon::store
