#pragma once

#include "reports/gate/gate_report.hpp"

#include <string>

namespace gnomon::reports {

/// What `gnomon gate --json` prints (docs/gate.md).
[[nodiscard]] std::string gate_json(const GateReport& report);

} // namespace gnomon::reports
