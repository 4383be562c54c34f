#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "analysis/depth/texel_class.hpp"
#include "scene/depth/sample.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::analysis {

/// A distance, what the formula makes of it, and what GL stored.
struct DepthErrorRow {
    double light_distance_m = 0;
    double depth = 0; ///< exact
    std::uint32_t formula_code = 0;
    double formula_error_m = 0; ///< the sawtooth
    double envelope_m = 0;
    std::uint32_t code = 0;             ///< GL's
    double stored_light_distance_m = 0; ///< the distance that GL's code stands for
    double error_m = 0;                 ///< stored_light_distance_m − light_distance_m
    double transform_error_m = 0;       ///< of the vertices' float32 transform, part of error_m
    double model_m = 0;                 ///< bound on |error_m|: transform, driver and either code
    TexelClass texel_class = TexelClass::nearest_code;
};

/// The formula's part of a row.
/// @param light_distance_m  [near, far]
[[nodiscard]] DepthErrorRow formula_row(const DepthMapping& mapping, const DepthCoding& coding,
                                        double light_distance_m);

/// @param mapping  that the sample was drawn with.
[[nodiscard]] DepthErrorRow depth_error_row(const DepthMapping& mapping, const DepthCoding& coding,
                                            const scene::DepthSample& sample);

/// A measurement beside the formula. Sums run over all samples.
struct MeasuredDepthError {
    std::vector<DepthErrorRow> rows; ///< by growing distance
    std::size_t missing = 0;
    double max_error_m = 0; ///< magnitude
    double max_error_light_distance_m = 0;
    double rms_error_m = 0;
    double mean_error_m = 0;
    double standard_deviation_m = 0;
    double max_excess_m = 0; ///< largest |error| − envelope; negative if no sample leaves it
    double max_transform_error_m = 0;
    double max_share_of_model = 0; ///< largest |error| / model
    DepthCertificate certificate;
};

/// A row for each sample, in their order, and what they add up to.
/// @throws std::invalid_argument  if there is no sample.
[[nodiscard]] MeasuredDepthError measured_depth_error(const DepthMapping& mapping,
                                                      const scene::DepthMeasurement& measurement);

} // namespace gnomon::analysis
