#include "csv_table.hpp"

#include "temporary_folder.hpp"

#include <stdexcept>
#include <utility>

namespace gnomon::store {

namespace {

/// Removes the first cell from the text. Returns it with the character that ends it.
std::pair<std::string, char> take_cell(std::string_view& text)
{
    std::string cell;
    const bool is_quoted = text.starts_with('"');
    std::size_t i = is_quoted ? 1 : 0;
    for (; i < text.size(); ++i) {
        const bool ends = is_quoted ? text[i] == '"' : text[i] == ',' || text[i] == '\n';
        if (ends && is_quoted && i + 1 < text.size() && text[i + 1] == '"') {
            ++i;
        } else if (ends) {
            break;
        }
        cell += text[i];
    }
    i += is_quoted ? 1 : 0;
    if (i >= text.size() || (text[i] != ',' && text[i] != '\n')) {
        throw std::runtime_error("parse_csv: unterminated cell: " + cell);
    }
    const char end = text[i];
    text.remove_prefix(i + 1);
    return {cell, end};
}

std::vector<std::string> take_row(std::string_view& text)
{
    std::vector<std::string> cells;
    while (true) {
        auto [cell, end] = take_cell(text);
        cells.push_back(std::move(cell));
        if (end == '\n') {
            return cells;
        }
    }
}

} // namespace

CsvTable parse_csv(std::string_view text)
{
    CsvTable table{take_row(text), {}};
    while (!text.empty()) {
        const std::vector<std::string> cells = take_row(text);
        if (cells.size() != table.columns.size()) {
            throw std::runtime_error("parse_csv: a row differs in length from the header");
        }
        auto& row = table.rows.emplace_back();
        for (std::size_t i = 0; i < cells.size(); ++i) {
            row[table.columns[i]] = cells[i];
        }
    }
    return table;
}

CsvTable read_csv(const std::filesystem::path& path)
{
    return parse_csv(tests::read_text(path));
}

} // namespace gnomon::store
