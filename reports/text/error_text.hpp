#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/comparison/comparison.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

/// Sentences about errors, their causes and their cures: the parts of `findings`. All of them need
/// a comparison with a diagnosis.
namespace gnomon::reports {

/// A share in whole percent: "82 %", "under 1 %", "over 99 %".
[[nodiscard]] std::string share_of(double part, double whole);

template <std::size_t size>
[[nodiscard]] double sum_of(const std::array<double, size>& errors)
{
    return std::accumulate(errors.begin(), errors.end(), 0.0);
}

/// Indices of the errors that are worth naming, the largest first.
template <std::size_t size>
[[nodiscard]] std::vector<std::size_t> largest_errors(const std::array<double, size>& errors)
{
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < size; ++i) {
        if (analysis::is_worth_naming(errors, i)) {
            order.push_back(i);
        }
    }
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return errors.at(i); });
    return order;
}

/// A cause as a phrase: "the map's resolution".
[[nodiscard]] std::string_view cause_text(analysis::Cause cause, bool has_map);

/// What to check for a cause if the method has no map, whose precision or resolution could be
/// raised; empty for most causes.
[[nodiscard]] std::string_view hint_without_map(analysis::Cause cause);

/// "4.51 % of the lit surface shadows itself (acne)"
/// @param amount  of errors with the label [px].
[[nodiscard]] std::string label_text(analysis::Label label, double amount,
                                     const analysis::ClassCounts& pixels, bool has_map);

/// The errors and the change that cures each: "63 % of the error is acne, which this bias cures,
/// as finer texels would; 37 % is ragged edges, which only finer texels cure." Only measured
/// changes are called cures. Empty if it would only repeat `error_summary`.
/// @param first  The remedy printed beside the sentence; may be null.
[[nodiscard]] std::string cure_sentence(const analysis::Comparison& comparison,
                                        const analysis::Remedy* first);

/// Whether a cause may be named as the one to act on: its cure alone was measured and removes at
/// least half of the cause's errors, and `first` is null or acts on the same cause.
[[nodiscard]] bool is_actionable(const analysis::Comparison& comparison, analysis::Cause cause,
                                 const analysis::Remedy* first);

/// The errors in plain words and their share of the surface: "48.1 % of the lit surface shadows
/// itself (acne)." Amounts exclude intended softening by a kernel.
[[nodiscard]] std::string error_summary(const analysis::Comparison& comparison);

/// The most frequent error alone, as a heading: "48.1 % of the lit surface shadows itself (acne)";
/// with ", by amount" if verdicts are fractions.
/// `error_summary` without its full stop if no error has a name.
[[nodiscard]] std::string error_headline(const analysis::Comparison& comparison);

/// `cure_sentence`, and the causes that `is_actionable` allows; may be empty.
/// @param first  The remedy printed beside the sentences; may be null.
[[nodiscard]] std::string cause_sentences(const analysis::Comparison& comparison,
                                          const analysis::Remedy* first);

/// The job's other biases if biases cause errors, or what to check if there is no map. Without a
/// full stop; may be empty.
[[nodiscard]] std::string bias_or_map_hint(const analysis::Comparison& comparison);

/// That the scene's distance from the origin may cause errors, and how to find out; empty if no
/// error comes from float32 transforms, or the scene is near its origin.
[[nodiscard]] std::string origin_hint(const analysis::Comparison& comparison);

/// Why no constant bias serves; empty if one does.
[[nodiscard]] std::string unserved_bias_text(const analysis::Comparison& comparison);

} // namespace gnomon::reports
