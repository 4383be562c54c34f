#pragma once

#include "store/csv/result_row.hpp"
#include "store/run/run_store.hpp"
#include "store/sqlite.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// Reads one snapshot of a run, even while another process writes it.
///
/// Every function throws as `RunStore` does.
class RunReader {
public:
    /// @param access  `read`, or `read_older` if the caller copes with columns that older runs
    ///                lack.
    explicit RunReader(const std::filesystem::path& folder,
                       RunStore::Access access = RunStore::Access::read);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const sqlite::Database& database() const { return database_; }
    [[nodiscard]] const RunSchema& schema() const { return schema_; }
    [[nodiscard]] const RunDescription& description() const { return description_; }
    [[nodiscard]] const PlanOutcome& outcome() const { return outcome_; }

    /// Rows of `results`.
    /// @param clause  SQL behind the table's name: "WHERE … ORDER BY … LIMIT 1".
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
