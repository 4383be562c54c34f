#pragma once

#include "store/output_file.hpp"
#include "store/sqlite.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::store {

/// Replaces bytes that are not UTF-8, and control characters other than tabs and line ends, with
/// U+FFFD.
[[nodiscard]] std::string readable_text(std::string_view text);

/// Appends a number as the shortest text that reads back as the same double.
void append_csv_number(std::string& out, double number);

/// Appends a `readable_text` as a cell of RFC 4180, in double quotes if it needs them.
///
/// A text that a spreadsheet would take for a formula, because it starts with = + - @, a tab or a
/// carriage return, gets a single quote in front.
void append_csv_text(std::string& out, std::string_view text);

/// A value as in the CSV files, but without quotes; empty for NULL.
[[nodiscard]] std::string cell_text(const sqlite::ValueView& value);

/// Appends a value as a cell; nothing for NULL.
void append_cell(std::string& out, const sqlite::ValueView& value);

/// Appends columns of the statement's row, with commas between them.
void append_cells(std::string& out, const sqlite::Statement& statement, int first, int count);

/// A CSV file that is written row by row. It appears only when it is committed.
class CsvFile {
public:
    explicit CsvFile(const std::filesystem::path& path) : file_{path} {}

    void write_header(const sqlite::Statement& statement);
    void write_rows(sqlite::Statement& statement);
    /// Appends whole rows.
    void write_text(std::string_view rows);
    void commit();

private:
    static constexpr std::size_t block_bytes = 1U << 18U;

    void flush();

    OutputFile file_;
    std::string pending_;
};

} // namespace gnomon::store
