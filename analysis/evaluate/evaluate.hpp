#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/evaluate/checked_case.hpp"
#include "renderers/reference.hpp"

namespace gnomon::analysis {

/// Compares a case's mask with its truth. The result is filled in as GL's comparisons are, as far
/// as the case's data allow; its `evaluation` says what they do not tell.
/// @param checked      without a mistake.
/// @param environment  what drew the mask, and what judges it.
/// @return  It refers to the subject's mesh.
[[nodiscard]] Comparison evaluate(const Case& subject, CheckedCase checked,
                                  const renderers::RoundedReference& truth,
                                  Environment environment);

} // namespace gnomon::analysis
