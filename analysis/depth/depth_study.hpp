#pragma once

#include "analysis/depth/constant_tolerance.hpp"
#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "analysis/depth/measured_error.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// What the formulas say of a frustum and a format.
struct DepthTheory {
    double max_error_m = 0;
    double envelope_at_near_m = 0;
    double envelope_at_far_m = 0;
    double step_at_near_m = 0;
    double step_at_far_m = 0;
    double coarsest_at_m = 0; ///< where envelope and step are largest
    double largest_envelope_m = 0;
    double largest_step_m = 0;
    double half_of_codes_within_m = 0; ///< distance up to which half of the codes are spent
    double code_share_within_1m = 0;   ///< of the camera's plane
    std::optional<double> distance_of_1m_step_m;
    double float_limit_m = 0; ///< D32F is finer than D24 on one side of it only
    /// Bounds on what the vertex's transform does, as view then projection, and as one matrix;
    /// empty of distances, which no projection makes.
    std::optional<double> separate_transform_at_far_m;
    std::optional<double> premultiplied_transform_at_far_m;
};

/// @param offset_m  the camera stands at (offset, offset, offset) and looks along an axis.
[[nodiscard]] DepthTheory depth_theory(const DepthMapping& mapping, const DepthCoding& coding,
                                       double offset_m);

/// Theory of a frustum and a format, and what GL stored.
struct DepthStudy {
    DepthMapping mapping;
    DepthCoding coding;
    std::string format; ///< "d16", or "27-bit unorm" for what GL has not
    double tilt_rad = 0;
    double offset_m = 0;
    DepthTheory theory;
    std::optional<MeasuredDepthError> measured;
    std::string not_measured_because;                          ///< "" if it was
    std::optional<ConstantTolerance> tolerance = std::nullopt; ///< if it was asked about one
};

/// What the formula makes of distances spread evenly from near to far: rows without GL's part.
/// @param count  at least 2
[[nodiscard]] std::vector<DepthErrorRow> formula_rows(const DepthMapping& mapping,
                                                      const DepthCoding& coding, std::size_t count);

/// The same, and between them eight codes in detail, 129 rows: at near, at far, and where the
/// tolerance begins to be too small, or in the middle (√(near·far)) if that is nowhere between.
/// @return by growing distance, each once.
[[nodiscard]] std::vector<DepthErrorRow> tolerance_rows(const DepthMapping& mapping,
                                                        const DepthCoding& coding,
                                                        std::size_t count,
                                                        const ConstantTolerance& tolerance);

} // namespace gnomon::analysis
