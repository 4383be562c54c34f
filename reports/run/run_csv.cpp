#include "reports/run/run_csv.hpp"

#include "reports/output_file.hpp"
#include "reports/run/csv_text.hpp"

#include <fmt/format.h>

#include <cstdint>
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
        const int columns = statement.column_count();
        while (statement.step()) {
            for (int i = 0; i < columns; ++i) {
                if (i > 0) {
                    pending_ += ',';
                }
                append_cell(pending_, statement.value(i));
            }
            pending_ += '\n';
            if (pending_.size() >= block_bytes) {
                flush();
            }
        }
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

/// Curves that a result of this part belongs to, in the order of the first one's ordinal.
std::vector<std::string> exported_curves(const Database& database)
{
    Statement find{database,
                   "SELECT v.id, min(p.ordinal) AS first FROM part p CROSS JOIN configurations c"
                   " ON c.number = p.configuration JOIN curves v ON v.number = c.curve"
                   " WHERE c.status = 'done' GROUP BY c.curve ORDER BY first"};
    std::vector<std::string> ids;
    while (find.step()) {
        ids.push_back(find.text(0));
    }
    return ids;
}

/// Writes the rows of each curve.
/// @param query  with the curve's id as its parameter.
void write_curves(const Database& database, const std::vector<std::string>& curves,
                  const std::string& query, const std::filesystem::path& path)
{
    CsvFile file{path};
    Statement rows{database, query};
    file.write_header(rows);
    for (const std::string& curve : curves) {
        rows.bind(1, std::string_view{curve});
        file.write_rows(rows);
    }
    file.commit();
}

} // namespace

void write_run_csv(const Database& database, const std::filesystem::path& folder)
{
    Transaction moment{database, Transaction::Kind::read};
    const std::vector<std::string> curves = exported_curves(database);
    CsvFile results{folder / "results.csv"};
    Statement rows{database, "SELECT * FROM results ORDER BY ordinal"};
    results.write_header(rows);
    results.write_rows(rows);
    results.commit();
    // "job_bias" before "best_bias".
    write_curves(database, curves,
                 "SELECT * FROM error_vs_z WHERE curve = ? ORDER BY \"at\" DESC, lower_m",
                 folder / "error_vs_z.csv");
    write_curves(database, curves, "SELECT * FROM bias_curves WHERE curve = ? ORDER BY bias",
                 folder / "bias_curves.csv");
    moment.commit();
}

} // namespace gnomon::reports
