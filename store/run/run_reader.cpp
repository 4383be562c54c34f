#include "store/run/run_reader.hpp"

#include "scene/error.hpp"
#include "scene/one_line.hpp"
#include "store/csv/run_csv.hpp"
#include "store/run/run_plan.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::store {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Value;

namespace {

Value kept(const sqlite::ValueView& value)
{
    if (const auto* text = std::get_if<std::string_view>(&value)) {
        return std::string{*text};
    }
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return *integer;
    }
    if (const auto* real = std::get_if<double>(&value)) {
        return *real;
    }
    return {};
}

/// Opens the database of a folder that is known to hold one.
std::filesystem::path checked_path(const std::filesystem::path& folder, RunStore::Access access)
{
    (void)RunStore{folder, access};
    return results_path(folder);
}

} // namespace

ResultRow::ResultRow(const Statement& statement)
{
    for (int i = 0; i < statement.column_count(); ++i) {
        cells_.emplace_back(statement.column_name(i), kept(statement.value(i)));
    }
}

const Value* ResultRow::find(std::string_view column) const
{
    const auto cell = std::find_if(cells_.begin(), cells_.end(),
                                   [&](const auto& named) { return named.first == column; });
    return cell == cells_.end() ? nullptr : &cell->second;
}

std::optional<double> ResultRow::number(std::string_view column) const
{
    const Value* const value = find(column);
    if (value == nullptr) {
        return std::nullopt;
    }
    if (const auto* integer = std::get_if<std::int64_t>(value)) {
        return static_cast<double>(*integer);
    }
    const auto* const real = std::get_if<double>(value);
    return real == nullptr ? std::nullopt : std::optional{*real};
}

std::uint64_t ResultRow::count(std::string_view column) const
{
    const Value* const value = find(column);
    const auto* const integer = value == nullptr ? nullptr : std::get_if<std::int64_t>(value);
    return integer == nullptr ? 0 : static_cast<std::uint64_t>(*integer);
}

std::string ResultRow::text(std::string_view column) const
{
    const Value* const value = find(column);
    if (value == nullptr) {
        return {};
    }
    if (const auto* words = std::get_if<std::string>(value)) {
        return *words;
    }
    if (const auto* real = std::get_if<double>(value)) {
        return cell_text(*real);
    }
    const auto* const integer = std::get_if<std::int64_t>(value);
    return integer == nullptr ? std::string{} : cell_text(*integer);
}

RunReader::RunReader(const std::filesystem::path& folder, RunStore::Access access)
    : folder_{folder},
      database_{checked_path(folder, access), Database::Access::read},
      schema_{prepare_reading(database_)},
      moment_{database_, sqlite::Transaction::Kind::read},
      description_{read_description(database_)},
      outcome_{read_outcome(database_)}
{
    if (description_.size == 0) {
        throw scene::InputError(fmt::format("{}: nothing was planned in it: run `gnomon sweep`",
                                            scene::one_line(folder.string())));
    }
}

std::vector<ResultRow> RunReader::rows(std::string_view clause) const
{
    std::vector<ResultRow> rows;
    Statement find{database_, fmt::format("SELECT * FROM results {}", clause)};
    while (find.step()) {
        rows.emplace_back(find);
    }
    return rows;
}

} // namespace gnomon::store
