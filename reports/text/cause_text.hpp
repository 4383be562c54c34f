#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>
#include <string_view>

namespace gnomon::reports {

/// What an error is due to: "the map's resolution".
[[nodiscard]] std::string_view cause_text(analysis::Cause cause, bool has_map);

/// What to look at for a cause where there is no map: nothing is rounded that could be rounded
/// less.
[[nodiscard]] std::string_view to_try_without_map(analysis::Cause cause);

/// "4.51 % of the lit surface shadows itself (acne)"
/// @param amount  of errors with the label [px].
[[nodiscard]] std::string label_text(analysis::Label label, double amount,
                                     const analysis::ClassCounts& pixels, bool has_map);

} // namespace gnomon::reports
