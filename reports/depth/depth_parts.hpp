#pragma once

#include "analysis/depth/depth_mapping.hpp"
#include "analysis/depth/depth_study.hpp"
#include "analysis/depth/measured_error.hpp"
#include "scene/light/frustum.hpp"
#include "store/json.hpp"

#include <string>
#include <string_view>

/// Parts that several depth reports share.
namespace gnomon::reports {

/// "perspective, near 4 m, far 50 m, clip [-1, 1]", and ", reversed" if it is.
[[nodiscard]] std::string range_text(const scene::DepthRange& range);
/// `range_text`, or "distance over far, near 4 m, far 50 m" if the map stores no GL depth.
[[nodiscard]] std::string mapping_text(const analysis::DepthMapping& mapping);
/// "z" for the distance along the light's axis, "r" for the distance from the light.
[[nodiscard]] std::string_view distance_symbol(const analysis::DepthMapping& mapping);
/// A length with four digits: "0.004387 m".
[[nodiscard]] std::string metres(double length_m);

/// Theory and measurement without samples.
[[nodiscard]] store::Json depth_summary_json(const analysis::DepthStudy& study);
/// "projection", "near_m", "far_m", "reversed", "clip_range".
[[nodiscard]] store::Json frustum_json(const scene::DepthRange& range);
/// Counts by class, residuals and histogram of a certificate.
[[nodiscard]] store::Json certificate_json(const analysis::DepthCertificate& certificate);

} // namespace gnomon::reports
