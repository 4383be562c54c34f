#include "store/csv/run_csv.hpp"

#include "store/csv/csv_text.hpp"
#include "store/csv/result_row.hpp"
#include "store/run/run_columns.hpp"
#include "store/run/run_plan.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_pipeline.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::store {

namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

sqlite::ValueView view_of(const sqlite::Value& value)
{
    if (const auto* text = std::get_if<std::string>(&value)) {
        return std::string_view{*text};
    }
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return *integer;
    }
    const auto* const real = std::get_if<double>(&value);
    return real == nullptr ? sqlite::ValueView{} : sqlite::ValueView{*real};
}

/// A curve of this part's results.
struct ExportedCurve {
    std::string id;
    std::string job_biases; ///< the biases of its jobs, as a JSON array
};

/// Sorted by the ordinal of the first result.
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

/// Adjacent columns of `results` with the same `Of`.
struct ResultsSpan {
    ResultsColumn::Of of;
    int columns = 0;
};

std::vector<ResultsSpan> results_spans(const std::vector<ResultsColumn>& columns)
{
    std::vector<ResultsSpan> spans;
    for (const ResultsColumn& column : columns) {
        if (spans.empty() || spans.back().of != column.of) {
            spans.push_back({column.of, 0});
        }
        ++spans.back().columns;
    }
    return spans;
}

/// The expressions of the columns with that `Of`, each after a comma.
std::string listed_columns(const std::vector<ResultsColumn>& columns, ResultsColumn::Of of)
{
    std::string text;
    for (const ResultsColumn& column : columns) {
        text += column.of == of ? ", " + column.expression : std::string{};
    }
    return text;
}

/// Reads a range of the results on its own connection. It reads and formats a curve's values once
/// for all of its configurations.
class ResultsReader {
public:
    explicit ResultsReader(const std::filesystem::path& path)
        : database_{path, Database::Access::read},
          schema_{prepare_reading(database_)},
          columns_{results_columns(light_columns(database_))},
          rows_{database_, fmt::format("SELECT c.curve, c.status = 'done'{} FROM part p CROSS JOIN"
                                       " configurations c ON c.number = p.configuration"
                                       " WHERE ordinal >= ? AND ordinal < ? ORDER BY ordinal",
                                       listed_columns(columns_, ResultsColumn::Of::configuration))},
          curve_{database_, fmt::format("SELECT k.number{} FROM curves k LEFT JOIN curves v"
                                        " ON v.number = k.number AND ?2 WHERE k.number = ?1",
                                        listed_columns(columns_, ResultsColumn::Of::curve))}
    {
    }

    [[nodiscard]] std::string text(std::int64_t first, std::int64_t last)
    {
        std::string text;
        rows_.bind(1, first).bind(2, last);
        while (rows_.step()) {
            read_curve({rows_.integer(0), rows_.integer(1)});
            append_row(text);
        }
        return text;
    }

private:
    /// A curve's number, and whether the configuration is done.
    using CurveKey = std::pair<std::int64_t, std::int64_t>;

    void read_curve(const CurveKey& key)
    {
        if (curve_key_ == key) {
            return;
        }
        curve_texts_.clear();
        if (!curve_.bind(1, key.first).bind(2, key.second).step()) {
            throw std::logic_error{"ResultsReader: a configuration's curve is missing"};
        }
        int column = 1;
        for (const ResultsSpan& span : spans_) {
            if (span.of == ResultsColumn::Of::curve) {
                std::string text;
                append_cells(text, curve_, column, span.columns);
                curve_texts_.push_back(std::move(text));
                column += span.columns;
            }
        }
        curve_.reset();
        curve_key_ = key;
    }

    void append_row(std::string& out)
    {
        int column = 2;
        auto curve_text = curve_texts_.begin();
        for (const ResultsSpan& span : spans_) {
            out += &span == spans_.data() ? "" : ",";
            if (span.of == ResultsColumn::Of::curve) {
                out += *curve_text++;
            } else {
                append_cells(out, rows_, column, span.columns);
                column += span.columns;
            }
        }
        out += '\n';
    }

    Database database_;
    RunSchema schema_; ///< unused; older schemas are shown as the present one
    std::vector<ResultsColumn> columns_;
    Statement rows_;
    Statement curve_;
    std::vector<ResultsSpan> spans_ = results_spans(columns_);
    std::optional<CurveKey> curve_key_;
    std::vector<std::string> curve_texts_; ///< one for each span of the curve
};

/// The rows of one configuration: the total, then its lights, all with the same ordinal.
std::string light_rows(std::span<const ResultRow> lights, std::size_t light_count)
{
    const std::int64_t number =
        static_cast<std::int64_t>(lights.front().count("ordinal") / light_count);
    std::string text;
    const auto append = [&](const auto& cells, const auto& value_of) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            text += i == 0 ? "" : ",";
            const bool is_ordinal = lights.front().cells()[i].first == "ordinal";
            append_cell(text, is_ordinal ? sqlite::ValueView{number} : view_of(value_of(cells[i])));
        }
        text += '\n';
    };
    append(
        total_row(lights, light_count), [](const auto& cell) -> const auto& { return cell; });
    for (const ResultRow& light : lights) {
        append(
            light.cells(), [](const auto& cell) -> const auto& { return cell.second; });
    }
    return text;
}

/// Writes the results of a run with several lights by ordinal, with a total for each configuration.
void write_results_of_lights(const Database& database, std::size_t light_count,
                             const std::filesystem::path& path)
{
    CsvFile file{path};
    Statement rows{database, "SELECT * FROM results ORDER BY ordinal"};
    file.write_header(rows);
    std::vector<ResultRow> lights;
    const auto flush = [&] {
        if (!lights.empty()) {
            file.write_text(light_rows(lights, light_count));
            lights.clear();
        }
    };
    while (rows.step()) {
        ResultRow row{rows};
        if (!lights.empty() &&
            row.count("ordinal") / light_count != lights.front().count("ordinal") / light_count) {
            flush();
        }
        lights.push_back(std::move(row));
    }
    flush();
    file.commit();
}

/// Writes the results by ordinal; several threads read and format them. Nobody writes the database
/// meanwhile, so all threads see the same data.
void write_results(const std::filesystem::path& results, const std::filesystem::path& path)
{
    const Database database{results, Database::Access::read};
    prepare_reading(database);
    if (const auto lights = read_description(database).lights; !lights.empty()) {
        return write_results_of_lights(database, lights.size(), path);
    }
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
            reader = std::make_unique<ResultsReader>(results);
        }
        return reader->text(first, first + rows_at_once);
    };
    const auto write = [&](const std::string& rows) { file.write_text(rows); };
    using tbb::filter_mode;
    // Isolated: if another task failed, cancelling this one could leave half of the rows.
    tbb::task_group_context own{tbb::task_group_context::isolated};
    tbb::parallel_pipeline(
        texts_at_once,
        tbb::make_filter<void, std::int64_t>(filter_mode::serial_in_order, take) &
            tbb::make_filter<std::int64_t, std::string>(filter_mode::parallel, read) &
            tbb::make_filter<std::string, void>(filter_mode::serial_in_order, write),
        own);
    file.commit();
}

/// Writes the rows of each curve.
/// @param query  its parameters are the curve's id and, if it has two, the biases of its jobs.
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

/// The errors by distance of a curve: at the biases of its jobs, then at the best one. DISTINCT,
/// because two jobs may write one bias differently.
std::string error_vs_z_query()
{
    return "SELECT DISTINCT " + error_vs_z_columns() +
           " WHERE v.id = ?1 AND (b.job_bias = '' OR b.job_bias IN"
           " (SELECT value FROM json_each(?2)))"
           " ORDER BY b.\"at\" DESC, b.bias, b.lower_m";
}

/// The errors by map of this part's configurations, in the order of the sweep.
std::string by_map_query()
{
    std::string columns;
    for (const auto& column : map_error_columns()) {
        columns += fmt::format(", m.{0} AS {0}", sqlite::sql_name(column.name));
    }
    return fmt::format("SELECT c.id AS id, v.id AS curve, m.map_index AS map_index{}"
                       " FROM (SELECT configuration, min(ordinal) AS first FROM part"
                       " GROUP BY configuration) p"
                       " JOIN configurations c ON c.number = p.configuration"
                       " JOIN curves v ON v.number = c.curve"
                       " JOIN map_errors m ON m.configuration = c.number"
                       " WHERE c.status = 'done' ORDER BY p.first, m.map_index",
                       columns);
}

/// Writes by_map.csv if the run has errors by map.
void write_by_map(const Database& database, const std::filesystem::path& path)
{
    if (!has_map_errors(database) || database.integer("SELECT count(*) FROM map_errors") == 0) {
        return;
    }
    CsvFile file{path};
    Statement rows{database, by_map_query()};
    file.write_header(rows);
    file.write_rows(rows);
    file.commit();
}

} // namespace

void write_run_csv(const Database& database, const std::filesystem::path& folder)
{
    Transaction moment{database, Transaction::Kind::read};
    const auto [results, error_vs_z, bias_curves, by_map] = run_csv_names;
    const std::filesystem::path results_file = folder / results;
    const std::filesystem::path error_file = folder / error_vs_z;
    const std::filesystem::path curves_file = folder / bias_curves;
    const std::filesystem::path maps_file = folder / by_map;
    tbb::parallel_invoke([&] { write_results(database.path(), results_file); },
                         [&] {
                             const auto curves = exported_curves(database);
                             write_curves(database, curves, error_vs_z_query(), error_file);
                             write_curves(database, curves,
                                          "SELECT * FROM bias_curves WHERE curve = ? ORDER BY bias",
                                          curves_file);
                             write_by_map(database, maps_file);
                         });
    moment.commit();
}

} // namespace gnomon::store
