#pragma once

#include "analysis/comparison/comparison.hpp"

#include <nlohmann/json_fwd.hpp>

namespace gnomon::reports {

/// Adds what a comparison's diagnosis found: causes, labels, gaps, the bias curve and breakdowns.
/// Without a diagnosis the fixed names are null, never a number.
void add_diagnosis(nlohmann::ordered_json& json, const analysis::Comparison& comparison);

} // namespace gnomon::reports
