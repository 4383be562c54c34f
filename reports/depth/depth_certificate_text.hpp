#pragma once

#include "analysis/depth/texel_class.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// The unit r of glPolygonOffset at a depth.
struct OffsetUnitLine {
    double depth = 0;
    double r = 0;
};

/// What the doctor found of a format.
struct CertifiedFormat {
    std::string name;
    analysis::DepthCertificate large; ///< of large triangles
    analysis::DepthCertificate small; ///< of small ones
    std::vector<OffsetUnitLine> offset_units;
};

/// A table: shares of each class and residuals by format and size of triangles, then the offset
/// units.
[[nodiscard]] std::string certificate_text(const std::vector<CertifiedFormat>& formats);

} // namespace gnomon::reports
