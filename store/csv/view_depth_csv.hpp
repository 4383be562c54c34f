#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>

namespace gnomon::store {

/// The errors by view depth as CSV (docs/csv_schema.md). Each row is a band, with all keys of the
/// job and the slices of its cascades.
/// @param bands  number of bands, [1, 254].
[[nodiscard]] std::string view_depth_csv(const analysis::Comparison& comparison, int bands);

} // namespace gnomon::store
