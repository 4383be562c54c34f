#pragma once

#include "reports/gate/gate_report.hpp"

#include <string>

namespace gnomon::reports {

/// What `gnomon gate` prints, with a final newline: the verdict, then the configurations with
/// broken rules, worst first, then what is missing, new and better.
[[nodiscard]] std::string gate_table(const GateReport& report);

} // namespace gnomon::reports
