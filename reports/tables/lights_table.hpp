#pragma once

#include "analysis/comparison/comparison.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// What `gnomon compare` prints of a job with several lights: each light's `comparison_table` under
/// its name, then a line for each light and one for all of them together.
/// @param lights  at least one.
[[nodiscard]] std::string lights_table(std::span<const analysis::Comparison> lights);

} // namespace gnomon::reports
