#pragma once

#include "analysis/comparison/comparison.hpp"

#include <nlohmann/json_fwd.hpp>

namespace gnomon::reports {

/// Turns a comparison's JSON into that of another renderer's case: adds `evaluate`, what r and d
/// tell of the causes, and `indeterminate_kinds.rounding`; makes null what the case does not tell.
/// @param evaluation  of that comparison.
void add_evaluation(nlohmann::ordered_json& json, const analysis::Comparison& comparison,
                    const analysis::Evaluation& evaluation);

/// `evaluate.import_check`.
[[nodiscard]] nlohmann::ordered_json import_check_json(const analysis::ImportCheck& check);

/// What `gnomon evaluate --check --json` prints, with a final newline.
[[nodiscard]] std::string check_json(const analysis::ImportCheck& check);

} // namespace gnomon::reports
