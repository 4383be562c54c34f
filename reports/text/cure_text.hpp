#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>

namespace gnomon::reports {

/// What the error is, and which change cures it: "63 % of the error is acne, which this bias cures,
/// as finer texels would; 37 % is ragged edges, which only finer texels cure." Only what was
/// measured is called a cure. Empty where nothing is to be said of it.
/// @param comparison  with a diagnosis.
/// @param first       The remedy that stands beside the sentence; nullptr: none does.
[[nodiscard]] std::string cures_as_text(const analysis::Comparison& comparison,
                                        const analysis::Remedy* first);

/// Whether a cause may be named as the one to act on: its cure, applied alone, was measured and
/// takes away at least half of what is laid to it, and the remedy beside the sentence is of its
/// kind.
/// @param comparison  with a diagnosis.
/// @param first       as above.
[[nodiscard]] bool is_to_act_on(const analysis::Comparison& comparison, analysis::Cause cause,
                                const analysis::Remedy* first);

} // namespace gnomon::reports
