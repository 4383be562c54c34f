#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_error.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "analysis/depth/measured_error.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// The formulas' results for a frustum and a format.
struct DepthTheory {
    double max_error_m = 0;
    double envelope_at_near_m = 0;
    double envelope_at_far_m = 0;
    double step_at_near_m = 0;
    double step_at_far_m = 0;
    double coarsest_at_m = 0; ///< where envelope and step are largest
    double largest_envelope_m = 0;
    double largest_step_m = 0;
    double half_of_codes_within_m = 0; ///< distance up to which half of the codes lie
    double code_share_within_1m = 0;   ///< from the camera's plane
    std::optional<double> distance_of_1m_step_m;
    double float_limit_m = 0; ///< D32F is finer than D24 only on one side of it
    /// Bounds on the error of the vertex transform, as view then projection, and as one matrix;
    /// empty if the map stores distances, which no projection makes.
    std::optional<double> separate_transform_at_far_m;
    std::optional<double> premultiplied_transform_at_far_m;
};

/// @param offset_m  The camera stands at (offset, offset, offset) and looks along an axis.
[[nodiscard]] DepthTheory depth_theory(const DepthMapping& mapping, const DepthCoding& coding,
                                       double offset_m);

/// The theory for a frustum and a format, and GL's results.
struct DepthStudy {
    DepthMapping mapping;
    DepthCoding coding;
    std::string format; ///< "d16", or "27-bit unorm" for a format that GL lacks
    double tilt_rad = 0;
    double offset_m = 0;
    DepthTheory theory;
    std::optional<MeasuredDepthError> measured;
    std::string not_measured_because;                          ///< "" if it was
    std::optional<ConstantTolerance> tolerance = std::nullopt; ///< only if one was asked about
};

/// The formula's rows for distances spread evenly from near to far, without GL's part.
/// @param count  at least 2
[[nodiscard]] std::vector<DepthErrorRow> formula_rows(const DepthMapping& mapping,
                                                      const DepthCoding& coding, std::size_t count);

/// `formula_rows`, and eight codes in detail (129 rows) at three places: at near, at far, and where
/// the tolerance first is too small, or in the middle (√(near·far)) if there is no such place.
/// @return  By growing distance, each once.
[[nodiscard]] std::vector<DepthErrorRow> tolerance_rows(const DepthMapping& mapping,
                                                        const DepthCoding& coding,
                                                        std::size_t count,
                                                        const ConstantTolerance& tolerance);

} // namespace gnomon::analysis
