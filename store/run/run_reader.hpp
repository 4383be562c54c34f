#pragma once

#include "store/run/run_store.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <filesystem>
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
    /// A number; empty where there is none.
    [[nodiscard]] std::optional<double> number(std::string_view column) const;
    /// A count; 0 where there is none.
    [[nodiscard]] std::uint64_t count(std::string_view column) const;
    /// As in the CSV file, without its quotes; empty where there is no value.
    [[nodiscard]] std::string text(std::string_view column) const;

private:
    [[nodiscard]] const sqlite::Value* find(std::string_view column) const;

    std::vector<std::pair<std::string, sqlite::Value>> cells_;
};

/// A run that is only read: one moment of it, whoever writes meanwhile.
///
/// Every function throws as `RunStore` does.
class RunReader {
public:
    /// @param access  `read`, or `read_older` for what can do without the numbers that older runs
    ///                lack.
    explicit RunReader(const std::filesystem::path& folder,
                       RunStore::Access access = RunStore::Access::read);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const sqlite::Database& database() const { return database_; }
    [[nodiscard]] const RunSchema& schema() const { return schema_; }
    [[nodiscard]] const RunDescription& description() const { return description_; }
    [[nodiscard]] const PlanOutcome& outcome() const { return outcome_; }

    /// Rows of `results`.
    /// @param clause  SQL after the name of the table: "WHERE … ORDER BY … LIMIT 1".
    [[nodiscard]] std::vector<ResultRow> rows(std::string_view clause) const;

private:
    std::filesystem::path folder_;
    sqlite::Database database_;
    RunSchema schema_;
    sqlite::Transaction moment_;
    RunDescription description_;
    PlanOutcome outcome_;
};

} // namespace gnomon::store
