#pragma once

#include "reports/gate/gate_report.hpp"

#include <string>

namespace gnomon::reports {

/// "false_shadow 106 -> 215 (+109), 5 allowed, of object wall; rule \"few\"". One line.
[[nodiscard]] std::string finding_sentence(const GateReport& report,
                                           const analysis::GateFinding& finding);

/// What a finding breaks: "5 allowed", "max 3", "min 2", or why a value is not available.
[[nodiscard]] std::string broken_limit_text(const GateReport& report,
                                            const analysis::GateFinding& finding);

/// "(12, 7), (13, 7) and 40 more, from (12, 7) to (90, 31); 38 by bias".
[[nodiscard]] std::string new_pixels_text(const analysis::NewPixels& pixels);

/// The parameters that changed, the first 10: "bias.constant: 0.24 -> 0.96; …". One line.
[[nodiscard]] std::string suspects_text(const std::vector<analysis::ParameterChange>& changes);

/// "pass: 3 configurations compared with baseline.json: 0 rules broken, 1 warning".
[[nodiscard]] std::string verdict_sentence(const GateReport& report);

/// Why nothing is decided, one reason a line; empty if the run is complete.
[[nodiscard]] std::vector<std::string> unfinished_sentences(const GateReport& report);

} // namespace gnomon::reports
