#pragma once

#include "raster_gl/context.hpp"
#include "reports/depth/depth_certificate_report.hpp"

namespace gnomon::cli {

/// Classifies every texel that large and small triangles surely cover, in each of the driver's
/// formats and in u8, u16 and u24, and measures the unit of glPolygonOffset.
///
/// Near 4 to far 50 in the clip ranges [-1, 1] and [0, 1] and reversed, and near 0.1 to far 1000
/// reversed, where most depths are small and a driver's bound with them.
/// @throws scene::EnvironmentError  if GL fails.
/// Source: docs/depth_precision.md#certificate.
[[nodiscard]] reports::DriverCertificate certify_driver_depth(const raster_gl::Context& context);

} // namespace gnomon::cli
