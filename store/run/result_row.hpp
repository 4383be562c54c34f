#pragma once

#include "store/sqlite.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::store {

/// A row of `results` by its columns (docs/csv_schema.md).
class ResultRow {
public:
    explicit ResultRow(const sqlite::Statement& statement);

    [[nodiscard]] const std::vector<std::pair<std::string, sqlite::Value>>& cells() const
    {
        return cells_;
    }
    /// The column's number, or nothing.
    [[nodiscard]] std::optional<double> number(std::string_view column) const;
    /// The column's count, or 0.
    [[nodiscard]] std::uint64_t count(std::string_view column) const;
    /// As in the CSV file, without its quotes; empty where there is no value.
    [[nodiscard]] std::string text(std::string_view column) const;

private:
    [[nodiscard]] const sqlite::Value* find(std::string_view column) const;

    std::vector<std::pair<std::string, sqlite::Value>> cells_;
};

} // namespace gnomon::store
