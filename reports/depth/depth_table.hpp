#pragma once

#include "analysis/depth/depth_study.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// A study for people: what was asked, the formulas, what GL stored, and a few distances side by
/// side.
/// @param rows  measured ones, or the formula's.
[[nodiscard]] std::string depth_table(const analysis::DepthStudy& study,
                                      std::span<const analysis::DepthErrorRow> rows,
                                      const std::string& gl_renderer);

/// "99.7 % nearest code, 0.3 % within the format, …", classes without texels left out.
[[nodiscard]] std::string classes_text(const analysis::DepthCertificate& certificate);

} // namespace gnomon::reports
