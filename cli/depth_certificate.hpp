#pragma once

#include "raster_gl/context.hpp"
#include "reports/depth/depth_certificate_text.hpp"

#include <vector>

namespace gnomon::cli {

/// Classifies every texel that large and small triangles surely cover, near 4 to far 50, in each of
/// the driver's formats and in u8, u16 and u24, and measures the unit of glPolygonOffset.
/// @throws scene::EnvironmentError  if GL fails.
/// Source: docs/depth_precision.md#certificate.
[[nodiscard]] std::vector<reports::CertifiedFormat>
certify_driver_depth(const raster_gl::Context& context);

} // namespace gnomon::cli
