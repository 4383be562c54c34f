#include "reports/tables/table_lines.hpp"

#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace gnomon::reports {

namespace {

constexpr std::size_t name_columns = 16;
constexpr std::size_t count_columns = 13;
constexpr std::size_t rate_columns = 11;

/// Removes trailing blanks.
std::string trimmed(std::string line)
{
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

} // namespace

std::string setting_line(std::string_view name, std::string_view value)
{
    return trimmed(pad_right(name, name_columns) + std::string{value});
}

std::string count_line(std::string_view name, std::string_view count, std::string_view rate,
                       std::string_view note)
{
    return trimmed(pad_right(name, name_columns) + pad_left(count, count_columns) +
                   pad_left(rate, rate_columns) + "  " + std::string{note});
}

std::string heading_line(std::string_view words)
{
    constexpr std::size_t columns = 79;
    const std::string text = fmt::format("-- {} ", words);
    return text + std::string(columns - std::min(columns, text.size()), '-') + "\n";
}

std::string note_lines(std::span<const scene::SceneNote> notes)
{
    std::string text;
    for (const scene::SceneNote& note : notes) {
        text += setting_line(text.empty() ? "note" : "", note.text);
    }
    return text;
}

std::string shown_name(std::string_view name)
{
    std::string shown{name};
    std::ranges::replace(shown, '_', '-');
    return shown;
}

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
