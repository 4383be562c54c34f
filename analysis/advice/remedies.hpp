#pragma once

#include "analysis/comparison.hpp"

#include <vector>

namespace gnomon::analysis {

/// Every change that is known to leave less error than the job has, of those that were measured and
/// those that the bias curves hold. First those that cure most of what can be cured, the cheapest
/// first: by the map's bytes, then by taps; then the others by what they leave.
///
/// A remedy cures most if it takes away at least four fifths of what the best one does. Errors are
/// amounts without what a kernel softens on purpose; for lookups with one comparison they are
/// counts.
/// @return  Empty without a diagnosis.
[[nodiscard]] std::vector<Remedy> ranked_remedies(const Comparison& comparison);

/// The amount of error of the comparison itself, without what a kernel softens on purpose [px];
/// without a diagnosis softening is not known and counts, too.
[[nodiscard]] double error_amount(const Comparison& comparison);

} // namespace gnomon::analysis
