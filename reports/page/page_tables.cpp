#include "reports/page/page_data.hpp"

#include "store/csv/csv_text.hpp"
#include "store/run/run_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace gnomon::reports {

namespace {

using store::sqlite::Statement;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t most_points = 400'000;
constexpr std::size_t most_bins = 60'000;

double number_in(const store::sqlite::ValueView& value)
{
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return static_cast<double>(*integer);
    }
    const auto* const real = std::get_if<double>(&value);
    return real == nullptr ? no_number : *real;
}

store::Json named(std::string_view name, const store::Json& block)
{
    store::Json json{{"name", name}};
    json.update(block);
    return json;
}

/// Packs whole numbers as uint32, others as doubles.
PackedArray pack_numbers(const std::vector<double>& numbers)
{
    constexpr double end = std::numeric_limits<std::uint32_t>::max();
    const bool are_counts = std::all_of(numbers.begin(), numbers.end(), [](double number) {
        return number >= 0 && number < end && number == std::floor(number);
    });
    if (!are_counts) {
        return pack(std::span<const double>{numbers});
    }
    std::vector<std::uint32_t> counts;
    counts.reserve(numbers.size());
    for (const double number : numbers) {
        counts.push_back(static_cast<std::uint32_t>(number));
    }
    return pack(std::span<const std::uint32_t>{counts});
}

enum class Constant : std::uint8_t { is_stored, is_left_out };

/// Reads a column row by row. If constants are left out, it stores nothing until two rows differ.
class ColumnReader {
public:
    ColumnReader(std::string name, Constant constant)
        : name_{std::move(name)},
          is_stored_{constant == Constant::is_stored}
    {
    }

    void add(const store::sqlite::ValueView& value)
    {
        if (rows_ == 0) {
            first_ = store::cell_text(value);
            first_number_ = number_in(value);
            first_is_text_ = std::holds_alternative<std::string_view>(value);
        } else if (!is_stored_ && store::cell_text(value) != first_) {
            spread();
        }
        if (is_stored_) {
            store(value);
        }
        ++rows_;
    }

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::size_t rows() const { return rows_; }
    [[nodiscard]] bool is_stored() const { return is_stored_; }
    /// The first row's value as text; empty for no value.
    [[nodiscard]] const std::string& first() const { return first_; }

    [[nodiscard]] store::Json pack_into(PackedBlocks& blocks) const
    {
        return named(name_, texts_.empty() ? blocks.add(pack_numbers(numbers_))
                                           : blocks.add_texts(all_texts()));
    }

private:
    void spread()
    {
        is_stored_ = true;
        numbers_.assign(rows_, first_number_);
        for (std::size_t row = 0; first_is_text_ && row < rows_; ++row) {
            texts_.emplace_back(row, first_);
        }
    }
    void store(const store::sqlite::ValueView& value)
    {
        numbers_.push_back(number_in(value));
        if (std::holds_alternative<std::string_view>(value)) {
            texts_.emplace_back(rows_, store::cell_text(value));
        }
    }
    [[nodiscard]] std::vector<std::string> all_texts() const
    {
        std::vector<std::string> all;
        all.reserve(rows_);
        for (const double number : numbers_) {
            all.push_back(std::isnan(number) ? std::string{} : store::cell_text(number));
        }
        for (const auto& [row, text] : texts_) {
            all[row] = text;
        }
        return all;
    }

    std::string name_;
    bool is_stored_;
    std::size_t rows_ = 0;
    std::string first_;
    double first_number_ = no_number;
    bool first_is_text_ = false;
    std::vector<double> numbers_;                            ///< NaN for texts and missing values
    std::vector<std::pair<std::size_t, std::string>> texts_; ///< with their rows
};

std::vector<ColumnReader> empty_columns(const Statement& rows, Constant constant)
{
    std::vector<ColumnReader> columns;
    for (int i = 0; i < rows.column_count(); ++i) {
        columns.emplace_back(rows.column_name(i), constant);
    }
    return columns;
}

void read_rows(Statement& rows, std::vector<ColumnReader>& columns)
{
    while (rows.step()) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            columns[i].add(rows.value(static_cast<int>(i)));
        }
    }
}

std::string point_query()
{
    std::vector<std::string> names;
    for (const auto& column : store::point_columns()) {
        names.push_back(column.name);
    }
    return fmt::format("SELECT {} FROM curve_points WHERE curve ="
                       " (SELECT number FROM curves WHERE id = ?) ORDER BY point",
                       fmt::join(names, ", "));
}

/// Reads the points of curves and keeps every n-th.
class PointReader {
public:
    PointReader(const store::sqlite::Database& database, std::size_t stride)
        : find_{database, point_query()},
          stride_{stride},
          values_(store::point_columns().size())
    {
    }

    void read(const std::string& curve)
    {
        const std::size_t before = points();
        first_.push_back(static_cast<std::uint32_t>(before));
        find_.bind(1, std::string_view{curve});
        std::size_t index = 0;
        std::vector<double> last(values_.size());
        while (find_.step()) {
            for (std::size_t i = 0; i < last.size(); ++i) {
                last[i] = number_in(find_.value(static_cast<int>(i)));
            }
            if (index++ % stride_ == 0) {
                keep(last);
            }
        }
        if (index > 0 && (index - 1) % stride_ != 0) {
            keep(last);
        }
        count_.push_back(static_cast<std::uint32_t>(points() - before));
    }

    void pack_into(PackedBlocks& blocks, store::Json& columns, store::Json& points_json) const
    {
        columns.push_back(named("first_point", blocks.add(pack(std::span{first_}))));
        columns.push_back(named("points", blocks.add(pack(std::span{count_}))));
        points_json["count"] = points();
        points_json["columns"] = store::Json::array();
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const auto& column = store::point_columns()[i];
            points_json["columns"].push_back(named(
                column.name, blocks.add(column.is_integer() ? packed_as<std::uint32_t>(values_[i])
                                                            : packed_as<float>(values_[i]))));
        }
    }

private:
    [[nodiscard]] std::size_t points() const { return values_.front().size(); }
    template <typename Number>
    static PackedArray packed_as(const std::vector<double>& values)
    {
        std::vector<Number> numbers(values.size());
        std::ranges::transform(values, numbers.begin(),
                               [](double value) { return static_cast<Number>(value); });
        return pack(std::span{numbers});
    }
    void keep(const std::vector<double>& point)
    {
        for (std::size_t i = 0; i < point.size(); ++i) {
            values_[i].push_back(point[i]);
        }
    }

    Statement find_;
    std::size_t stride_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> count_;
    std::vector<std::vector<double>> values_; ///< by column
};

} // namespace

PageTable read_table(const store::RunReader& run, PackedBlocks& blocks)
{
    Statement rows{run.database(), "SELECT * FROM results ORDER BY ordinal"};
    PageTable table;
    std::size_t count = 0;
    store::Json columns = store::Json::array();
    std::vector<ColumnReader> read = empty_columns(rows, Constant::is_left_out);
    read_rows(rows, read);
    for (const ColumnReader& column : read) {
        count = column.rows();
        if (!column.is_stored()) {
            if (!column.first().empty()) {
                table.constants[column.name()] = column.first();
            }
        } else if (column.name() != "id" || count <= most_rows_with_ids) {
            columns.push_back(column.pack_into(blocks));
        }
    }
    table.columns = {{"count", count}, {"columns", std::move(columns)}};
    return table;
}

std::vector<std::string> curve_ids(const store::RunReader& run)
{
    Statement find{run.database(), "SELECT curve FROM results WHERE status = 'done'"
                                   " GROUP BY curve ORDER BY min(ordinal)"};
    std::vector<std::string> ids;
    while (find.step()) {
        ids.push_back(find.text(0));
    }
    return ids;
}

store::Json read_curves(const store::RunReader& run, const std::vector<std::string>& curves,
                        PackedBlocks& blocks)
{
    const std::int64_t points = run.database().integer("SELECT count(*) FROM curve_points");
    const auto stride = static_cast<std::size_t>((points + most_points - 1) / most_points);
    PointReader reader{run.database(), std::max<std::size_t>(stride, 1)};
    for (const std::string& curve : curves) {
        reader.read(curve);
    }
    store::Json columns = store::Json::array({named("id", blocks.add_texts(curves))});
    store::Json packed_points;
    reader.pack_into(blocks, columns, packed_points);
    return {{"count", curves.size()},
            {"columns", std::move(columns)},
            {"points", std::move(packed_points)},
            {"thinned", stride > 1}};
}

store::Json read_error_vs_z(const store::RunReader& run, const std::vector<std::string>& curves,
                            PackedBlocks& blocks)
{
    Statement rows{run.database(), "SELECT * FROM error_vs_z WHERE curve = ?"
                                   " ORDER BY \"at\" DESC, bias, lower_m"};
    std::vector<ColumnReader> columns = empty_columns(rows, Constant::is_stored);
    std::vector<double> curve_of_row;
    std::size_t shown = 0;
    for (; shown < curves.size() && curve_of_row.size() < most_bins; ++shown) {
        rows.bind(1, std::string_view{curves[shown]});
        read_rows(rows, columns);
        curve_of_row.resize(columns.front().rows(), static_cast<double>(shown));
    }
    store::Json packed =
        store::Json::array({named("curve", blocks.add(pack_numbers(curve_of_row)))});
    for (const ColumnReader& column : columns) {
        if (column.name() != "curve") {
            packed.push_back(column.pack_into(blocks));
        }
    }
    return {{"count", curve_of_row.size()}, {"columns", std::move(packed)}, {"curves", shown}};
}

} // namespace gnomon::reports
