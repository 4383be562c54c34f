#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_judgement.hpp"
#include "reports/gate/gate_report.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/json.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Names and sentences that the gate's outputs share. Texts are one line.
namespace gnomon::reports {

/// "object wall, cause bias, zeta_band [4, 16) m"; empty if the filter takes all pixels.
[[nodiscard]] std::string filter_text(const analysis::PixelFilter& filter);
/// The filter as members; `zeta_band` is an array of two, null for an infinite end.
[[nodiscard]] store::Json filter_json(const analysis::PixelFilter& filter);

/// A metric's value: pixel counts grouped, others with six digits; "-" if it has none.
[[nodiscard]] std::string metric_text(std::string_view metric, const std::optional<double>& value);
/// The change of a metric: "+1,234"; empty without both values.
[[nodiscard]] std::string change_text(std::string_view metric, const std::optional<double>& before,
                                      const std::optional<double>& now);

/// "shadow_map.depth_format: d24 -> d16".
[[nodiscard]] std::string change_line(const analysis::ParameterChange& change);

/// "llvmpipe (LLVM 15), 4.5 Mesa, Embree 3.13.5".
[[nodiscard]] std::string renderer_text(const analysis::Environment& environment);

/// "worse_than_baseline", …: the reason codes of docs/gate.md.
[[nodiscard]] std::string_view reason_code(analysis::GateReason reason);

/// "false_shadow 106 -> 215 (+109), 5 allowed, of object wall; rule \"few\"".
[[nodiscard]] std::string finding_sentence(const GateReport& report,
                                           const analysis::GateFinding& finding);

/// The limit that a finding breaks: "5 allowed", "max 3", "min 2", or why a value is missing.
[[nodiscard]] std::string broken_limit_text(const GateReport& report,
                                            const analysis::GateFinding& finding);

/// "(12, 7), (13, 7) and 40 more, from (12, 7) to (90, 31); 38 by bias".
[[nodiscard]] std::string new_pixels_text(const analysis::NewPixels& pixels);

/// The first 10 parameters that changed: "bias.constant: 0.24 -> 0.96; …".
[[nodiscard]] std::string suspects_text(const std::vector<analysis::ParameterChange>& changes);

/// "pass: 3 configurations compared with baseline.json: 0 rules broken, 1 warning".
[[nodiscard]] std::string verdict_sentence(const GateReport& report);

/// Why the gate could not decide, one reason per line; empty if the run is complete.
[[nodiscard]] std::vector<std::string> unfinished_sentences(const GateReport& report);

} // namespace gnomon::reports
