#pragma once

#include "analysis/comparison/comparison.hpp"

#include <cstdint>
#include <vector>

namespace gnomon::analysis {

/// How a remedy changes one measure of the error.
enum class Change : std::uint8_t { less, as_before, more };

/// A remedy's effects besides reducing the amount of error without softening.
struct ErrorChanges {
    Change wrong_pixels = Change::less;
    Change amount = Change::less; ///< including intended softening

    [[nodiscard]] bool worsens() const
    {
        return wrong_pixels == Change::more || amount == Change::more;
    }
};
[[nodiscard]] ErrorChanges changes_of(const Comparison& comparison, const Remedy& remedy);

/// The changes that are known to reduce the job's error, measured or from the bias curves, in this
/// order. First, the changes that cure most, cheapest first: by the map's bytes, then by taps. At
/// equal cost, first those that repair a bias that the job sets; another slope comes last. Then the
/// other changes, by the error they leave. Last, those that reduce the amount of error but make
/// more pixels wrong or increase the amount including softening; the list never starts with one.
///
/// A remedy cures most if it removes at least four fifths of what the best one removes. Errors are
/// amounts without intended softening, or counts for lookups with one comparison. Changes that
/// light more than half of the true shadow are left out.
/// @return  Empty without a diagnosis, or if nothing could come first: see `trade_offs`.
[[nodiscard]] std::vector<Remedy> ranked_remedies(const Comparison& comparison);

/// If no change is better in every respect: those that reduce the amount of error without softening
/// but worsen the wrong pixels or the amount with softening. The least remaining error comes first.
[[nodiscard]] std::vector<Remedy> trade_offs(const Comparison& comparison);

/// Whether at least half of the true shadow is dark.
[[nodiscard]] bool keeps_shadows(const Comparison& comparison, const Outcome& outcome);

/// The comparison's own amount of error without intended softening [px]. Without a diagnosis
/// softening is unknown, and is included.
[[nodiscard]] double error_amount(const Comparison& comparison);

} // namespace gnomon::analysis
