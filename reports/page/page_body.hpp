#pragma once

#include "reports/page/report_options.hpp"
#include "reports/page/run_overview.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// The part of a page that can be read without JavaScript: from the header to the end of main.
/// @param pictures  data: addresses of the figures, in their order.
[[nodiscard]] std::string page_body(const store::RunReader& run, const RunOverview& overview,
                                    const ReportOptions& options,
                                    std::span<const std::string> pictures);

} // namespace gnomon::reports
