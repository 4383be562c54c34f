#pragma once

#include "analysis/depth/texel_class.hpp"
#include "scene/depth/offset_unit.hpp"
#include "scene/light/depth_range.hpp"
#include "store/json.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// What a driver stored in a format, of large triangles and of small ones.
struct CertifiedFormat {
    std::string name;
    analysis::DepthCertificate large;
    analysis::DepthCertificate small;
};

/// Formats under one range of depth.
struct CertifiedRange {
    scene::DepthRange range;
    std::vector<CertifiedFormat> formats;
};

struct FormatOffsetUnits {
    std::string name;
    std::vector<scene::OffsetUnit> units; ///< at least one
};

/// What the doctor found of a driver's depths; empty if it was not asked for.
struct DriverCertificate {
    std::vector<CertifiedRange> ranges;
    std::vector<FormatOffsetUnits> offset_units;
};

/// A table for each range, shares of each class and residuals by format and size of triangles, then
/// the offset units.
[[nodiscard]] std::string certificate_text(const DriverCertificate& certificate);

/// The same as JSON: "ranges" and "offset_units"; docs/depth_precision.md names the members.
[[nodiscard]] store::Json driver_certificate_json(const DriverCertificate& certificate);

} // namespace gnomon::reports
