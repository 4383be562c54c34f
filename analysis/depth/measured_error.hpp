#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "scene/depth/measured_planes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// How near a stored code is to the exact depth of its plane; each class includes the earlier ones.
enum class TexelClass : std::uint8_t {
    nearest_code,  ///< the code nearest to the exact depth
    within_format, ///< one of the two nearest, between which GL lets a conversion choose
    within_model,  ///< converted from a depth within the driver's bound B of the exact one
    outside        ///< none of these
};
inline constexpr std::size_t texel_class_count = 4;
/// "nearest_code", "within_format", "within_model", "outside".
[[nodiscard]] std::string_view texel_class_name(TexelClass texel_class);

/// The first class that the texel's stored code belongs to.
/// Source: docs/depth_precision.md#certificate.
[[nodiscard]] TexelClass classify_texel(const DepthCoding& coding, const scene::TexelDepth& texel);

/// Stored minus exact depth in codes: in units of q, or of the float's last place at the exact
/// depth; packed: of twice the half step there.
[[nodiscard]] double residual_codes(const DepthCoding& coding, const scene::TexelDepth& texel);

/// How well a driver stored many texels.
struct DepthCertificate {
    std::size_t texels = 0;
    std::array<std::size_t, texel_class_count> counts{}; ///< by class, each texel once
    double largest_residual_codes = 0;                   ///< magnitude
    double rms_residual_codes = 0;
    double largest_share_of_bound = 0; ///< |stored − exact| / (B + the conversion's error)
    /// Texels by |residual| in codes: up to ½, 1, 2, 4, … 2^12, and above.
    std::array<std::size_t, 15> histogram{};

    [[nodiscard]] std::size_t count(TexelClass texel_class) const
    {
        return counts.at(static_cast<std::size_t>(texel_class));
    }
};
/// Upper end of a bin of `histogram` [codes]; infinite for the last.
[[nodiscard]] double histogram_end_codes(std::size_t bin);

[[nodiscard]] DepthCertificate certify_texels(const DepthCoding& coding,
                                              std::span<const scene::TexelDepth> texels);

/// A distance, its depth by the formula, and GL's.
struct DepthErrorRow {
    double light_distance_m = 0;
    double depth = 0; ///< exact
    std::uint32_t formula_code = 0;
    double formula_error_m = 0; ///< the sawtooth
    double envelope_m = 0;
    std::uint32_t code = 0;             ///< GL's
    double stored_light_distance_m = 0; ///< the distance that GL's code stands for
    double error_m = 0;                 ///< stored_light_distance_m − light_distance_m
    double transform_error_m = 0;       ///< by the vertices' float32 transform; part of error_m
    double model_m = 0;                 ///< bound on |error_m|: transform, driver and conversion
    TexelClass texel_class = TexelClass::nearest_code;
};

/// The formula's part of a row.
/// @param light_distance_m  [near, far]
[[nodiscard]] DepthErrorRow formula_row(const DepthMapping& mapping, const DepthCoding& coding,
                                        double light_distance_m);

/// @param mapping  With which the sample was drawn.
[[nodiscard]] DepthErrorRow depth_error_row(const DepthMapping& mapping, const DepthCoding& coding,
                                            const scene::DepthSample& sample);

/// A measurement compared with the formula. Sums run over all samples.
struct MeasuredDepthError {
    std::vector<DepthErrorRow> rows; ///< by growing distance
    std::size_t missing = 0;
    double max_error_m = 0; ///< magnitude
    double max_error_light_distance_m = 0;
    double rms_error_m = 0;
    double mean_error_m = 0;
    double standard_deviation_m = 0;
    double max_excess_m = 0; ///< largest |error| − envelope; negative if all samples are within it
    double max_transform_error_m = 0;
    double max_share_of_model = 0; ///< largest |error| / model
    DepthCertificate certificate;
};

/// A row for each sample, in order, and their statistics.
/// @throws std::invalid_argument  if there is no sample.
[[nodiscard]] MeasuredDepthError measured_depth_error(const DepthMapping& mapping,
                                                      const scene::DepthMeasurement& measurement);

} // namespace gnomon::analysis
