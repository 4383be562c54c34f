#pragma once

#include "reports/page/ranked_rows.hpp"
#include "store/json_values.hpp"
#include "store/run/run_reader.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::reports {

/// What a report says first of a run.
struct RunOverview {
    std::string scene;                  ///< of the scene that all share; empty if they differ
    std::string_view length_unit = "m"; ///< "units" of scene files whose unit nobody says
    std::vector<std::string> sentences;
    std::vector<std::string> notes; ///< on its scenes
    /// The configuration with the lowest error rate, of several that with the smallest map; of
    /// several cases the first case's. Empty if none was measured.
    std::optional<OverviewRow> headline;
    /// Whether several cases were measured. They are what is looked at, and no settings: none is
    /// ranked against another.
    bool has_cases = false;
    store::Json detail; ///< what `compare --json` says of it; null if its layers were not kept
    /// Those of the headline table, lowest error rate first; the last has the highest. Of several
    /// cases the best of each, in the order of the job.
    std::vector<OverviewRow> rows;
    std::vector<OverviewRow> failed; ///< the first that could not be computed
    std::uint64_t failed_count = 0;
};

[[nodiscard]] RunOverview read_overview(const store::RunReader& run);

/// The columns of one cause or label, and the name by which people know it:
/// {"causes.bias", "cause_amounts.bias", "bias"}.
struct KindColumns {
    std::string count;
    std::string amount;
    std::string name;
};
[[nodiscard]] const std::vector<KindColumns>& cause_columns();
[[nodiscard]] const std::vector<KindColumns>& label_columns();

/// Whether causes and labels are known: not where another renderer told too little of its lookups.
[[nodiscard]] bool has_causes(const store::ResultRow& row);
/// What is said where they are not.
constexpr const char* causes_not_known =
    "Causes and names of the errors are not known: the renderer told too little of its lookups.";

/// Whether amounts say more than counts do: verdicts are fractions.
[[nodiscard]] bool has_amounts(const store::ResultRow& row);

} // namespace gnomon::reports
