#pragma once

#include "analysis/depth/depth_study.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// A line per sample under a header; docs/depth_precision.md names the columns. What was not
/// measured is an empty cell; the column of the tolerance is there where the study has one.
[[nodiscard]] std::string depth_csv(const analysis::DepthStudy& study,
                                    std::span<const analysis::DepthErrorRow> rows);

} // namespace gnomon::reports
