#pragma once

#include "analysis/depth/depth_study.hpp"
#include "analysis/depth/texel_class.hpp"
#include "scene/light/depth_range.hpp"
#include "store/json.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// A study as one JSON object; docs/depth_precision.md names its members.
/// @param rows  the samples to write: measured ones, or the formula's.
/// @param gl_renderer, gl_version  empty if nothing was measured.
[[nodiscard]] std::string depth_json(const analysis::DepthStudy& study,
                                     std::span<const analysis::DepthErrorRow> rows,
                                     const std::string& gl_renderer, const std::string& gl_version);

/// Theory and measurement without samples.
[[nodiscard]] store::Json depth_summary_json(const analysis::DepthStudy& study);

/// "projection", "near_m", "far_m", "reversed", "clip_range".
[[nodiscard]] store::Json frustum_json(const scene::DepthRange& range);

/// Counts by class, residuals and histogram of a certificate.
[[nodiscard]] store::Json certificate_json(const analysis::DepthCertificate& certificate);

} // namespace gnomon::reports
