#include "store/csv/csv_file.hpp"

#include "store/csv/csv_text.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <variant>

namespace gnomon::store {

namespace {

/// Appends the statement's rows, as far as it has any.
/// @param most_bytes  where to stop, after a whole row.
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
