#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>

namespace gnomon::reports {

/// What helps, ranked, a line each: what it leaves, what it costs, and how that is known. Where
/// each of them worsens something, the best one has no number.
/// @return  With the views behind it, if there are several; empty if nothing helps.
[[nodiscard]] std::string remedy_table(const analysis::Comparison& comparison);

} // namespace gnomon::reports
