#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>
#include <vector>

/// Parts of the tables that `gnomon compare` and `evaluate` print.
namespace gnomon::reports {

/// The head of a case's table: renderer, scene, light, image and the import check.
/// @param evaluation  of that comparison.
[[nodiscard]] std::string evaluation_settings(const analysis::Comparison& comparison,
                                              const analysis::Evaluation& evaluation);

/// The errors of a case without a diagnosis, and the questions that the case cannot answer.
/// @param evaluation  of that comparison.
[[nodiscard]] std::string evaluation_table(const analysis::Comparison& comparison,
                                           const analysis::Evaluation& evaluation);

/// Causes, labels, gaps, errors by object and advice as tables; empty without a diagnosis.
[[nodiscard]] std::string diagnosis_table(const analysis::Comparison& comparison);

/// The objects with the most errors; empty without errors, or with only one object.
[[nodiscard]] std::string object_table(const std::vector<analysis::ObjectErrors>& objects);

/// The findings after an empty line, one per line; empty if there are none.
[[nodiscard]] std::string findings_text(const analysis::Comparison& comparison);

/// The ranked remedies, one per line: remaining errors, cost, and how they are known. If each
/// remedy worsens something, the best one has no number. If several views were checked, their
/// results follow.
/// @return  Empty if nothing helps.
[[nodiscard]] std::string remedy_table(const analysis::Comparison& comparison);

} // namespace gnomon::reports
