#pragma once

#include "analysis/comparison.hpp"
#include "analysis/evaluate/case_truth.hpp"
#include "analysis/evaluate/checked_case.hpp"

namespace gnomon::analysis {

/// Compares a case's mask with its truth. The result is filled in as GL's comparisons are, as far
/// as the case's data allow; its `evaluation` says what they do not tell.
/// @param checked  without a mistake.
/// @return  It refers to the subject's mesh.
[[nodiscard]] Comparison evaluate(const Case& subject, CheckedCase checked, const CaseTruth& truth);

} // namespace gnomon::analysis
