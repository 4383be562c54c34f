#pragma once

#include "reports/page/report_options.hpp"
#include "reports/page/run_overview.hpp"

#include <string>
#include <string_view>

namespace gnomon::reports {

/// A text in Markdown, on one line, that stays what it is: no markup, no HTML, no mention.
[[nodiscard]] std::string markdown_text(std::string_view text);

/// summary.md: the verdict, a table and links to pictures; fits a pull request.
[[nodiscard]] std::string summary_text(const store::RunReader& run, const RunOverview& overview,
                                       const ReportOptions& options);

} // namespace gnomon::reports
