#pragma once

#include "reports/gate/gate_report.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// The text as the message of a workflow command: `%` and ends of lines are escaped.
[[nodiscard]] std::string github_message(std::string_view text);
/// The text as a property of one: `:` and `,` too.
/// Source: github.com/actions/toolkit, packages/core/src/command.ts.
[[nodiscard]] std::string github_property(std::string_view text);
/// The text as a cell of a table in Markdown: one line, what has a meaning there escaped.
[[nodiscard]] std::string markdown_cell(std::string_view text);

/// Workflow commands that annotate a build with the worst 10 findings and what is unfinished, a
/// line each; empty if there is nothing to say.
[[nodiscard]] std::string github_annotations(const GateReport& report);

/// The gate as Markdown, for $GITHUB_STEP_SUMMARY.
/// @param most_bytes  It has no more: worst first, and rows that do not fit are counted.
/// @return  Empty if not even the text without rows fits.
[[nodiscard]] std::string github_summary(const GateReport& report, std::size_t most_bytes);

} // namespace gnomon::reports
