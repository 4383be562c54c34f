#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>

namespace gnomon::reports {

/// What is wrong, in people's words, and on how much of the surface: "48.1 % of the lit surface
/// shadows itself (acne)." Amounts are without what a kernel softens on purpose.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string what_is_wrong(const analysis::Comparison& comparison);

/// What the errors are and which change cures them, and the causes to act on: those alone whose
/// cure was measured and works. "88 % of the error is acne, which this bias cures." Empty where
/// nothing is to be said of them.
/// @param comparison  with a diagnosis.
/// @param first       The remedy that stands beside the sentence; nullptr: none does.
[[nodiscard]] std::string what_it_comes_from(const analysis::Comparison& comparison,
                                             const analysis::Remedy* first);

/// What the job has beside the constant bias where biases are at fault, and what to look at where
/// there is no map, without its full stop; empty where there is nothing to say.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string what_is_set_beside(const analysis::Comparison& comparison);

/// That positions far from the origin may be at fault, and how to learn it; empty where no error
/// comes from float32 transforms, or the scene is near its origin.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string why_to_move_origin(const analysis::Comparison& comparison);

/// Why no constant bias serves; empty where one does.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string why_none_serves(const analysis::Comparison& comparison);

} // namespace gnomon::reports
