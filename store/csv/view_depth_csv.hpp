#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>

namespace gnomon::store {

/// The errors by view depth as CSV, a row a band, as docs/csv_schema.md has it: with every key of
/// the job, and where the slices of cascades lie.
/// @param bands  of view depth, [1, 254].
[[nodiscard]] std::string view_depth_csv(const analysis::Comparison& comparison, int bands);

} // namespace gnomon::store
