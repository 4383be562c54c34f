#pragma once

#include "reports/page/report_options.hpp"
#include "store/json_values.hpp"
#include "store/run/run_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The configurations and sentences that head a report. Configurations that differ only in biases
/// and have the same errors share a row.
namespace gnomon::reports {

/// A configuration, or several with the same errors.
struct OverviewRow {
    std::uint64_t row = 0; ///< its index among the run's configurations, from 0
    /// "shadow_map.resolution = 2048, bias.constant = 0.01 to 0.03 (9 configurations)"; empty if
    /// the run has only one configuration.
    std::string settings;
    std::string mean_error; ///< "0.218 %", or "0.218 % to 0.258 %" for several
    store::ResultRow result;
};

constexpr std::size_t most_rows_shown = 10;

/// A row of one configuration.
[[nodiscard]] OverviewRow named_row(const store::RunReader& run, store::ResultRow row);

/// The measured cases, in the job's order.
[[nodiscard]] std::vector<std::string> measured_cases(const store::RunReader& run);

/// SQL conditions that select one case, or one light.
[[nodiscard]] std::string of_case(const std::string& name);
[[nodiscard]] std::string of_light(const std::string& name);

/// SQL conditions, "AND …", that each select configurations which may be ranked against each other:
/// those of one case and one light. At least one; empty if the run has neither.
[[nodiscard]] std::vector<std::string> comparable_groups(const store::RunReader& run);

/// The lowest error rates first, ties by the smallest map; the last row has the highest.
[[nodiscard]] std::vector<OverviewRow> ranked_rows(const store::RunReader& run);

/// The best and the worst of some rows; only the best if all are equally good.
/// @param condition  "AND …", which rows; empty: all.
[[nodiscard]] std::vector<OverviewRow> best_and_worst(const store::RunReader& run,
                                                      std::string_view condition);

/// The head of a run's report.
struct RunOverview {
    std::string scene;                  ///< empty if the configurations have several
    std::string_view length_unit = "m"; ///< "units" if scene files do not give theirs
    std::vector<std::string> sentences;
    std::vector<std::string> notes; ///< on its scenes
    /// The configuration with the lowest error rate, ties by the smallest map; with several cases,
    /// that of the first. If only lights differ, the light with the highest error rate. Empty if
    /// nothing was measured.
    std::optional<OverviewRow> headline;
    /// Whether several cases were measured. Cases are not ranked against each other.
    bool has_cases = false;
    bool is_one = false;       ///< the run is a single comparison
    bool is_of_lights = false; ///< the run compares several lights, and sweeps nothing
    store::Json detail;        ///< its `compare --json`; null if its layers were not kept
    /// The headline table: `ranked_rows`, or the best of each case if there are several.
    std::vector<OverviewRow> rows;
    std::vector<OverviewRow> worst;  ///< of each case in `rows`; empty without several cases
    std::vector<OverviewRow> failed; ///< the first configurations that failed
    std::uint64_t failed_count = 0;
};

[[nodiscard]] RunOverview read_overview(const store::RunReader& run);

/// The columns of one cause or label, and its display name:
/// {"causes.bias", "cause_amounts.bias", "bias"}.
struct KindColumns {
    std::string count;
    std::string amount;
    std::string name;
};
[[nodiscard]] const std::vector<KindColumns>& cause_columns();
[[nodiscard]] const std::vector<KindColumns>& label_columns();

/// Whether causes and labels are known. They are not if another renderer's case lacks lookup data.
[[nodiscard]] bool has_causes(const store::ResultRow& row);
constexpr const char* causes_not_known =
    "Causes and names of the errors are not known: the renderer told too little of its lookups.";

/// Whether amounts differ from counts because verdicts are fractions.
[[nodiscard]] bool has_amounts(const store::ResultRow& row);

/// Escapes a text for one line of Markdown: no markup, HTML or mentions.
[[nodiscard]] std::string markdown_text(std::string_view text);

/// summary.md: the answer, three pictures and a table, short enough for a pull request.
/// @param pictures  three, or none.
[[nodiscard]] std::string summary_text(const store::RunReader& run, const RunOverview& overview,
                                       const ReportOptions& options,
                                       std::span<const HeadlinePicture> pictures);

} // namespace gnomon::reports
