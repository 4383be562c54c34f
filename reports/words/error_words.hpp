#pragma once

#include "analysis/comparison.hpp"

#include <string>

namespace gnomon::reports {

/// What is wrong, in people's words, and on how much of the surface: "48.1 % of the lit surface
/// shadows itself (acne)." Amounts are without what a kernel softens on purpose.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string what_is_wrong(const analysis::Comparison& comparison);

/// What the errors come from: "88 % of the error is due to the map's resolution." Empty where there
/// is none.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string what_it_comes_from(const analysis::Comparison& comparison);

/// What of the map to look at for most of the errors, without its full stop; empty where there is
/// nothing to say.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string what_to_try(const analysis::Comparison& comparison);

/// Why no constant bias serves; empty where one does.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string why_none_serves(const analysis::Comparison& comparison);

} // namespace gnomon::reports
