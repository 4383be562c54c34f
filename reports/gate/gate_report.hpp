#pragma once

#include "analysis/gate/gate_judgement.hpp"
#include "analysis/gate/gate_rules.hpp"
#include "reports/page/report_options.hpp"
#include "store/baseline/gate_run.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The outputs of `gnomon gate`.
namespace gnomon::reports {

struct GateReport {
    std::filesystem::path baseline_file;
    analysis::GateEntries baseline;
    store::GateRun run;
    std::vector<analysis::GateRule> rules;
    analysis::GateOutcome outcome;
    analysis::GateVerdict verdict = analysis::GateVerdict::pass;
    std::map<std::size_t, std::filesystem::path> pictures = {}; ///< by the finding's index
    /// The worst finding's wrong pixels before, after, and the new ones alone; three, or none.
    std::vector<HeadlinePicture> panels = {};
};

/// The file of a finding's picture; empty if it has none.
/// @param finding  One of the report's.
[[nodiscard]] std::string picture_of(const GateReport& report,
                                     const analysis::GateFinding& finding);

/// The cause that grew most among a finding's pixels; for metrics that count no pixels, the
/// configuration's.
[[nodiscard]] std::optional<analysis::DominantCause>
cause_of_finding(const GateReport& report, const analysis::GateFinding& finding);

/// How much `gate_table` prints.
enum class GateDetail : std::uint8_t {
    worst, ///< ten lines: the worst configuration, its changed keys and its worst findings
    all,   ///< every finding, and the missing, new and better configurations
};

/// The verdict; the configurations with broken rules, worst first, each with its changed keys and
/// its findings; then the missing, new and better configurations. With a final newline.
[[nodiscard]] std::string gate_table(const GateReport& report, GateDetail detail);

/// The gate as a page for people: the verdict, the suspects, the worst finding's pixels before and
/// after, the broken rules, and the commands that follow.
[[nodiscard]] std::string gate_page(const GateReport& report);

/// The JSON that `gnomon gate --json` prints (docs/gate.md).
[[nodiscard]] std::string gate_json(const GateReport& report);

/// Escapes a text for an element or a double-quoted attribute in XML 1.0, including newlines and
/// tabs. Characters that XML does not allow become U+FFFD.
[[nodiscard]] std::string xml_text(std::string_view text);

/// The gate as JUnit XML: one test case per configuration, and one for the whole run. A
/// configuration that breaks a rule is a failure; one that is missing or cannot be judged, an
/// error. Warnings and improvements are in system-out.
///
/// Output is reproducible: timestamps are 1970's, durations 0.
/// Source: Ant's format, as in https://github.com/windyroad/JUnit-Schema.
[[nodiscard]] std::string gate_junit(const GateReport& report);

/// JUnit XML for a run that cannot be compared with its baseline: one test case, in error.
/// @param problem  one line.
[[nodiscard]] std::string gate_junit_refusal(std::string_view baseline_file,
                                             std::string_view problem);

/// Escapes a text for the message of a GitHub workflow command: `%` and newlines.
[[nodiscard]] std::string github_message(std::string_view text);
/// Escapes a text for a property of a workflow command: `:` and `,` as well.
/// Source: github.com/actions/toolkit, packages/core/src/command.ts.
[[nodiscard]] std::string github_property(std::string_view text);
/// Escapes a text for a table cell in Markdown, on one line.
[[nodiscard]] std::string markdown_cell(std::string_view text);

/// Workflow commands that annotate a build with the 10 worst findings and the unfinished
/// configurations, one per line; empty if there are none.
[[nodiscard]] std::string github_annotations(const GateReport& report);

/// The gate as Markdown, for $GITHUB_STEP_SUMMARY.
/// @param most_bytes  The limit: rows are written worst first, and those that do not fit counted.
/// @return  Empty if not even the text without rows fits.
[[nodiscard]] std::string github_summary(const GateReport& report, std::size_t most_bytes);

/// Draws the pixels that became wrong, for the worst failed rules that count pixels, and adds the
/// files and the first picture's panels to the report. Needs the configuration's pixels in the
/// baseline and in the run. At most 10 pictures; rules on the same pixels share one.
/// @param folder  Created if there is something to draw.
/// @throws scene::InputError        if masks or kept pixels cannot be read.
/// @throws scene::EnvironmentError  if a picture cannot be drawn or written.
void write_gate_pictures(GateReport& report, const std::filesystem::path& folder);

} // namespace gnomon::reports
