#pragma once

#include "analysis/causes/cause.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace gnomon::analysis {

/// How much of the error each cause and each name has [px]: amounts without what a kernel softens
/// on purpose; where verdicts are no fractions they are counts.
struct NamedErrors {
    std::array<double, cause_names.size()> by_cause{};
    std::array<double, label_names.size()> by_label{};

    [[nodiscard]] double of(Cause cause) const { return by_cause[static_cast<std::size_t>(cause)]; }
    [[nodiscard]] double of(Label label) const { return by_label[static_cast<std::size_t>(label)]; }
};

/// @param has_fractions  Whether some verdict is neither right nor wholly wrong.
/// @param left_out       Of the softening, what is no error (`left_out`) [px].
[[nodiscard]] NamedErrors named_errors(const CauseCounts& counts, const CauseAmounts& amounts,
                                       bool has_fractions, double left_out);

/// Whether one of several errors, of which the first has no name, is the largest of them or a
/// quarter of all.
template <std::size_t size>
[[nodiscard]] bool is_worth_naming(const std::array<double, size>& errors, std::size_t i)
{
    constexpr double quarter = 0.25;
    const double all = std::accumulate(errors.begin(), errors.end(), 0.0);
    return i > 0 && errors[i] > 0 &&
           (errors[i] == std::ranges::max(errors) || errors[i] >= quarter * all);
}

} // namespace gnomon::analysis
