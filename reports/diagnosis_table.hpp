#pragma once

#include "analysis/comparison.hpp"

#include <string>

namespace gnomon::reports {

/// Causes, labels, gaps, errors by object and advice as tables; empty without a diagnosis.
[[nodiscard]] std::string diagnosis_table(const analysis::Comparison& comparison);

/// The findings, a line each, after an empty line; empty if there are none.
[[nodiscard]] std::string findings_text(const analysis::Comparison& comparison);

} // namespace gnomon::reports
