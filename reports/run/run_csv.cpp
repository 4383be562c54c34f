#include "reports/run/run_csv.hpp"

#include "reports/output_file.hpp"
#include "reports/run/csv_text.hpp"
#include "reports/run/run_schema.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

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

/// Appends the statement's rows, as far as it has any.
/// @param most_bytes  where to stop, after a whole row.
/// @return  False after the last row.
bool append_rows(std::string& out, Statement& statement, std::size_t most_bytes)
{
    const int columns = statement.column_count();
    while (out.size() < most_bytes) {
        if (!statement.step()) {
            return false;
        }
        for (int i = 0; i < columns; ++i) {
            if (i > 0) {
                out += ',';
            }
            append_cell(out, statement.value(i));
        }
        out += '\n';
    }
    return true;
}

/// A CSV file that is written row by row, and appears when it is whole.
class CsvFile {
public:
    explicit CsvFile(const std::filesystem::path& path) : file_{path} {}

    void write_header(const Statement& statement)
    {
        for (int i = 0; i < statement.column_count(); ++i) {
            pending_ += i == 0 ? "" : ",";
            append_csv_text(pending_, statement.column_name(i));
        }
        pending_ += '\n';
    }

    void write_rows(Statement& statement)
    {
        while (append_rows(pending_, statement, block_bytes)) {
            flush();
        }
    }

    /// Whole rows, after those that were written before.
    void write_text(std::string_view rows)
    {
        flush();
        file_.write(rows);
    }

    void commit()
    {
        flush();
        file_.commit();
    }

private:
    static constexpr std::size_t block_bytes = 1U << 18U;

    void flush()
    {
        file_.write(pending_);
        pending_.clear();
    }

    OutputFile file_;
    std::string pending_;
};

/// A curve that a result of this part belongs to.
struct ExportedCurve {
    std::string id;
    std::string job_biases; ///< of the jobs that ask for it, as a JSON array
};

/// In the order of the first result's ordinal.
std::vector<ExportedCurve> exported_curves(const Database& database)
{
    Statement find{database,
                   "SELECT v.id, json_group_array(a.job_bias), min(a.ordinal) AS first FROM"
                   " (SELECT c.curve, p.job_bias, min(p.ordinal) AS ordinal FROM part p"
                   " CROSS JOIN configurations c ON c.number = p.configuration"
                   " WHERE c.status = 'done' GROUP BY c.curve, p.job_bias) a"
                   " JOIN curves v ON v.number = a.curve GROUP BY a.curve ORDER BY first"};
    std::vector<ExportedCurve> curves;
    while (find.step()) {
        curves.push_back({find.text(0), find.text(1)});
    }
    return curves;
}

/// Reads a range of the results, on a connection of its own.
class ResultsReader {
public:
    explicit ResultsReader(const std::filesystem::path& path)
        : database_{path, Database::Access::read},
          rows_{database_, "SELECT * FROM results WHERE ordinal >= ? AND ordinal < ?"
                           " ORDER BY ordinal"}
    {
    }

    [[nodiscard]] std::string text(std::int64_t first, std::int64_t last)
    {
        std::string text;
        rows_.bind(1, first).bind(2, last);
        append_rows(text, rows_, std::numeric_limits<std::size_t>::max());
        return text;
    }

private:
    Database database_;
    Statement rows_;
};

/// Writes the results by ordinal; several threads read and format them. Nobody writes to the
/// database meanwhile, so that all of them see the same.
void write_results(const Database& database, const std::filesystem::path& path)
{
    constexpr std::int64_t rows_at_once = 512;
    constexpr std::size_t texts_at_once = 16;
    CsvFile file{path};
    file.write_header(Statement{database, "SELECT * FROM results"});
    const std::int64_t end = database.integer("SELECT max(ordinal) + 1 FROM part");
    tbb::enumerable_thread_specific<std::unique_ptr<ResultsReader>> readers;
    std::int64_t next = 0;
    const auto take = [&](tbb::flow_control& control) {
        const std::int64_t first = next;
        next += rows_at_once;
        if (first >= end) {
            control.stop();
        }
        return first;
    };
    const auto read = [&](std::int64_t first) {
        auto& reader = readers.local();
        if (!reader) {
            reader = std::make_unique<ResultsReader>(database.path());
        }
        return reader->text(first, first + rows_at_once);
    };
    const auto write = [&](const std::string& rows) { file.write_text(rows); };
    using tbb::filter_mode;
    tbb::parallel_pipeline(
        texts_at_once,
        tbb::make_filter<void, std::int64_t>(filter_mode::serial_in_order, take) &
            tbb::make_filter<std::int64_t, std::string>(filter_mode::parallel, read) &
            tbb::make_filter<std::string, void>(filter_mode::serial_in_order, write));
    file.commit();
}

/// Writes the rows of each curve.
/// @param query  with the curve's id as its first parameter; a second one is its jobs' biases.
void write_curves(const Database& database, const std::vector<ExportedCurve>& curves,
                  const std::string& query, const std::filesystem::path& path)
{
    CsvFile file{path};
    Statement rows{database, query};
    file.write_header(rows);
    const bool asks_for_biases = rows.parameter_count() > 1;
    for (const ExportedCurve& curve : curves) {
        rows.bind(1, std::string_view{curve.id});
        if (asks_for_biases) {
            rows.bind(2, std::string_view{curve.job_biases});
        }
        file.write_rows(rows);
    }
    file.commit();
}

/// The errors by distance of a curve: at its jobs' biases, then at the best one. Two jobs may say
/// the same bias in different words.
std::string error_vs_z_query()
{
    return "SELECT DISTINCT " + error_vs_z_columns() +
           " WHERE v.id = ?1 AND (b.job_bias = '' OR b.job_bias IN"
           " (SELECT value FROM json_each(?2)))"
           " ORDER BY b.\"at\" DESC, b.bias, b.lower_m";
}

} // namespace

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

void write_run_csv(const Database& database, const std::filesystem::path& folder)
{
    Transaction moment{database, Transaction::Kind::read};
    const std::vector<ExportedCurve> curves = exported_curves(database);
    const auto [results, error_vs_z, bias_curves] = run_csv_names;
    write_results(database, folder / results);
    write_curves(database, curves, error_vs_z_query(), folder / error_vs_z);
    write_curves(database, curves, "SELECT * FROM bias_curves WHERE curve = ? ORDER BY bias",
                 folder / bias_curves);
    moment.commit();
}

} // namespace gnomon::reports
