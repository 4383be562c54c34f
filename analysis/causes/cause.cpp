#include "analysis/causes/cause.hpp"

#include <algorithm>

namespace gnomon::analysis {

NamedErrors named_errors(const CauseCounts& counts, const CauseAmounts& amounts, bool has_fractions,
                         double left_out)
{
    NamedErrors errors;
    if (!has_fractions) {
        std::ranges::copy(counts.by_cause, errors.by_cause.begin());
        std::ranges::copy(counts.by_label, errors.by_label.begin());
        return errors;
    }
    errors = {amounts.by_cause, amounts.by_label};
    errors.by_cause[static_cast<std::size_t>(Cause::filter)] -= left_out;
    errors.by_label[static_cast<std::size_t>(Label::edge)] -= left_out;
    return errors;
}

} // namespace gnomon::analysis
