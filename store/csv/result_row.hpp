#pragma once

#include "store/sqlite.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::store {

/// A row of `results` (docs/csv_schema.md).
class ResultRow {
public:
    explicit ResultRow(const sqlite::Statement& statement);

    [[nodiscard]] const std::vector<std::pair<std::string, sqlite::Value>>& cells() const
    {
        return cells_;
    }
    /// The number in a column; empty if it holds none.
    [[nodiscard]] std::optional<double> number(std::string_view column) const;
    /// The integer in a column; 0 if it holds none.
    [[nodiscard]] std::uint64_t count(std::string_view column) const;
    /// The text in the CSV file, without quotes; empty for NULL.
    [[nodiscard]] std::string text(std::string_view column) const;

private:
    [[nodiscard]] const sqlite::Value* find(std::string_view column) const;

    std::vector<std::pair<std::string, sqlite::Value>> cells_;
};

/// The total row of a configuration's lights. Counts and amounts are sums; rates are computed from
/// the sums. Values that all lights share are kept; all others, and the light, are empty. The row
/// is `done` if all lights are.
/// @param lights       rows of `results`, one for each light; at least one.
/// @param light_count  lights of the configuration, including those in other parts of the run.
[[nodiscard]] std::vector<sqlite::Value> total_row(std::span<const ResultRow> lights,
                                                   std::size_t light_count);

} // namespace gnomon::store
