#pragma once

#include "store/run/run_reader.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Which of a run's configurations a report names. Those that differ in biases alone and have the
/// same errors are one row.
namespace gnomon::reports {

/// A configuration that a report names.
struct OverviewRow {
    std::uint64_t row = 0; ///< its index among the run's configurations, from 0
    /// "shadow_map.resolution = 2048, bias.constant = 0.01 to 0.03 (9 configurations)", which have
    /// the same errors; empty: one only.
    std::string settings;
    std::string mean_error; ///< "0.218 %", or "0.218 % to 0.258 %" of several configurations
    store::ResultRow result;
};

constexpr std::size_t most_rows_shown = 10;

/// A configuration by itself.
[[nodiscard]] OverviewRow named_row(const store::RunReader& run, store::ResultRow row);

/// The cases that were measured, in the order of the job.
[[nodiscard]] std::vector<std::string> measured_cases(const store::RunReader& run);

/// A condition of rows: of one case, and of one light.
[[nodiscard]] std::string of_case(const std::string& name);
[[nodiscard]] std::string of_light(const std::string& name);

/// The best of each of the first cases: what is wrong with one says nothing of another.
[[nodiscard]] std::vector<OverviewRow> rows_of_cases(const store::RunReader& run,
                                                     const std::vector<std::string>& cases);

/// The lowest error rate first, of equal ones that with the smallest map; the last is the highest.
[[nodiscard]] std::vector<OverviewRow> ranked_rows(const store::RunReader& run);

/// The best and the worst of some rows; the best alone where all are as good.
/// @param condition  "AND …", which; empty: all.
[[nodiscard]] std::vector<OverviewRow> best_and_worst(const store::RunReader& run,
                                                      std::string_view condition);

} // namespace gnomon::reports
