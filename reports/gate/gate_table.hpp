#pragma once

#include "reports/gate/gate_report.hpp"

#include <cstdint>
#include <string>

namespace gnomon::reports {

/// How much the table tells.
enum class GateDetail : std::uint8_t {
    worst, ///< the worst configuration, what changed in it and its worst findings: ten lines
    all,   ///< every finding, and what is missing, new and better
};

/// What `gnomon gate` prints, with a final newline: the verdict, then the configurations with
/// broken rules, worst first, each with what changed in its job before its findings; then what is
/// missing, new and better.
[[nodiscard]] std::string gate_table(const GateReport& report, GateDetail detail);

} // namespace gnomon::reports
