#pragma once

#include "analysis/comparison/comparison.hpp"

#include <cstdint>
#include <vector>

namespace gnomon::analysis {

/// How a remedy changes one measure of the error.
enum class Change : std::uint8_t { less, as_before, more };

/// What a remedy changes beside the amount of error without softening, which it lessens.
struct ErrorChanges {
    Change wrong_pixels = Change::less;
    Change amount = Change::less; ///< with what a kernel softens on purpose

    [[nodiscard]] bool worsens() const
    {
        return wrong_pixels == Change::more || amount == Change::more;
    }
};
[[nodiscard]] ErrorChanges changes_of(const Comparison& comparison, const Remedy& remedy);

/// Every change that is known to leave less error than the job has, of those that were measured and
/// those that the bias curves hold. First those that cure most of what can be cured, the cheapest
/// first: by the map's bytes, then by taps; of equal cost those that mend a bias that the job sets,
/// and another slope last. Then the others by what they leave. Last come changes that
/// lessen the amount of error and make more pixels wrong, or more of the amount with softening;
/// none does that is first.
///
/// A remedy cures most if it takes away at least four fifths of what the best one does. Errors are
/// amounts without what a kernel softens on purpose; for lookups with one comparison they are
/// counts. Changes that light more than half of what is truly in shadow are left out.
/// @return  Empty without a diagnosis, and where nothing would be first: see `trade_offs`.
[[nodiscard]] std::vector<Remedy> ranked_remedies(const Comparison& comparison);

/// The changes that lessen the amount of error without softening and worsen the wrong pixels, or
/// the amount with it, where nothing lessens it otherwise. What leaves least is first.
[[nodiscard]] std::vector<Remedy> trade_offs(const Comparison& comparison);

/// Whether at least half of what is truly in shadow is dark.
[[nodiscard]] bool keeps_shadows(const Comparison& comparison, const Outcome& outcome);

/// The amount of error of the comparison itself, without what a kernel softens on purpose [px];
/// without a diagnosis softening is not known and counts, too.
[[nodiscard]] double error_amount(const Comparison& comparison);

} // namespace gnomon::analysis
