#pragma once

#include "store/output_file.hpp"
#include "store/sqlite.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::store {

/// Appends a value as a cell; nothing for none.
void append_cell(std::string& out, const sqlite::ValueView& value);

/// Appends columns of the statement's row, with commas between them.
void append_cells(std::string& out, const sqlite::Statement& statement, int first, int count);

/// A CSV file that is written row by row, and appears when it is whole.
class CsvFile {
public:
    explicit CsvFile(const std::filesystem::path& path) : file_{path} {}

    void write_header(const sqlite::Statement& statement);
    void write_rows(sqlite::Statement& statement);
    /// Whole rows, after those that were written before.
    void write_text(std::string_view rows);
    void commit();

private:
    static constexpr std::size_t block_bytes = 1U << 18U;

    void flush();

    OutputFile file_;
    std::string pending_;
};

} // namespace gnomon::store
