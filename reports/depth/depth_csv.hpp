#pragma once

#include "analysis/depth/measured_error.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// A line per sample under a header; docs/depth_precision.md names the columns. What was not
/// measured is an empty cell.
[[nodiscard]] std::string depth_csv(std::span<const analysis::DepthErrorRow> rows,
                                    bool is_measured);

} // namespace gnomon::reports
