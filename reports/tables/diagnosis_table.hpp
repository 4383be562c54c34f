#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// Causes, labels, gaps, errors by object and advice as tables; empty without a diagnosis.
[[nodiscard]] std::string diagnosis_table(const analysis::Comparison& comparison);

/// The objects with the most errors; empty without errors, or where there is but one object.
[[nodiscard]] std::string object_table(const std::vector<analysis::ObjectErrors>& objects);

/// The findings, a line each, after an empty line; empty if there are none.
[[nodiscard]] std::string findings_text(const analysis::Comparison& comparison);

} // namespace gnomon::reports
