#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_judgement.hpp"
#include "store/baseline/configuration_text.hpp"
#include "store/json.hpp"

#include <optional>
#include <string>
#include <string_view>

/// How texts and JSON of the gate name things.
namespace gnomon::reports {

/// "object wall, cause bias, zeta_band [4, 16) m"; empty if it takes all. One line.
[[nodiscard]] std::string filter_text(const analysis::PixelFilter& filter);
/// Those members by the same names; `zeta_band` as an array of two, null for an infinite end.
[[nodiscard]] store::Json filter_json(const analysis::PixelFilter& filter);

/// A metric's value: counts of pixels grouped, others with six digits; "-" if there is none.
[[nodiscard]] std::string metric_text(std::string_view metric, const std::optional<double>& value);
/// How it changed: "+1,234"; empty without both values.
[[nodiscard]] std::string change_text(std::string_view metric, const std::optional<double>& before,
                                      const std::optional<double>& now);

/// "shadow_map.depth_format: d24 -> d16". One line.
[[nodiscard]] std::string change_line(const analysis::ParameterChange& change);

/// "llvmpipe (LLVM 15), 4.5 Mesa, Embree 3.13.5". One line.
[[nodiscard]] std::string renderer_text(const analysis::Environment& environment);

/// "worse_than_baseline", …: the reason codes of docs/gate.md.
[[nodiscard]] std::string_view reason_code(analysis::GateReason reason);

} // namespace gnomon::reports
