#pragma once

#include "analysis/depth/measured_error.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/light/frustum.hpp"
#include "store/json.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// A driver's stored depths in one format, for large and for small triangles.
struct CertifiedFormat {
    std::string name;
    analysis::DepthCertificate large;
    analysis::DepthCertificate small;
};

/// All formats for one depth range.
struct CertifiedRange {
    scene::DepthRange range;
    std::vector<CertifiedFormat> formats;
};

struct FormatOffsetUnits {
    std::string name;
    std::vector<scene::OffsetUnit> units; ///< at least one
};

/// The doctor's depth measurements; empty unless requested.
struct DriverCertificate {
    std::vector<CertifiedRange> ranges;
    std::vector<FormatOffsetUnits> offset_units;
};

/// One table per range with the share of each class and the residuals, by format and triangle
/// size; then the polygon offset units.
[[nodiscard]] std::string certificate_text(const DriverCertificate& certificate);

/// The certificate as JSON: "ranges" and "offset_units" (docs/depth_precision.md).
[[nodiscard]] store::Json driver_certificate_json(const DriverCertificate& certificate);

} // namespace gnomon::reports
