#pragma once

#include "reports/gate/gate_report.hpp"

#include <string>
#include <string_view>

namespace gnomon::reports {

/// A text for XML 1.0, inside an element or a double-quoted attribute: what is not allowed in it
/// becomes U+FFFD, and what has a meaning there, ends of lines and tabs too, is escaped.
[[nodiscard]] std::string xml_text(std::string_view text);

/// The gate as JUnit XML: a test case a configuration, and one for the run as a whole. A
/// configuration with a broken rule that fails is a failure; one that cannot be judged, or is
/// missing, an error. Warnings and improvements stand in system-out.
///
/// There are no times in it: its time stamps are 1970's, its durations 0.
/// Source: Ant's format, as in https://github.com/windyroad/JUnit-Schema.
[[nodiscard]] std::string gate_junit(const GateReport& report);

/// The same of a run that cannot be compared with its baseline: one test case, in error.
/// @param problem  one line.
[[nodiscard]] std::string gate_junit_refusal(std::string_view baseline_file,
                                             std::string_view problem);

} // namespace gnomon::reports
