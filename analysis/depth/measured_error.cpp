#include "analysis/depth/measured_error.hpp"

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

/// The residual as a share of what the driver's bound and conversion allow on its side.
double share_of_bound(const DepthCoding& coding, const scene::TexelDepth& texel)
{
    const double residual = coding.depth(texel.code) - texel.plane_depth;
    const double conversion = residual < 0
                                  ? conversion_drop(coding, texel.plane_depth - texel.driver_bound)
                                  : conversion_rise(coding, texel.plane_depth + texel.driver_bound);
    return std::abs(residual) / (texel.driver_bound + conversion);
}

/// Whether the code is one of the two nearest; packed, where near depths can have far codes, the
/// code of one of the two nearest float32s.
bool is_within_format(const DepthCoding& coding, std::uint32_t code, double exact)
{
    return coding.spacing() == scene::Spacing::packed ? may_be_converted(coding, code, exact, exact)
                                                      : nearest_codes(coding, exact).holds(code);
}

std::size_t bin_of(double magnitude_codes)
{
    constexpr std::size_t last = std::tuple_size_v<decltype(DepthCertificate::histogram)> - 1;
    std::size_t bin = 0;
    while (bin < last && magnitude_codes > histogram_end_codes(bin)) {
        ++bin;
    }
    return bin;
}

void add_moments(MeasuredDepthError& error)
{
    const auto count = static_cast<double>(error.rows.size());
    double sum_m = 0;
    double squares_m2 = 0;
    for (const DepthErrorRow& row : error.rows) {
        sum_m += row.error_m;
        squares_m2 += row.error_m * row.error_m;
    }
    error.mean_error_m = sum_m / count;
    error.rms_error_m = std::sqrt(squares_m2 / count);
    double deviations_m2 = 0;
    for (const DepthErrorRow& row : error.rows) {
        const double deviation_m = row.error_m - error.mean_error_m;
        deviations_m2 += deviation_m * deviation_m;
    }
    error.standard_deviation_m = std::sqrt(deviations_m2 / count);
}

void include_extremes(MeasuredDepthError& error, const DepthErrorRow& row)
{
    const double magnitude_m = std::abs(row.error_m);
    if (magnitude_m > error.max_error_m) {
        error.max_error_m = magnitude_m;
        error.max_error_light_distance_m = row.light_distance_m;
    }
    error.max_excess_m = std::max(error.max_excess_m, magnitude_m - row.envelope_m);
    error.max_transform_error_m =
        std::max(error.max_transform_error_m, std::abs(row.transform_error_m));
    error.max_share_of_model = std::max(error.max_share_of_model, magnitude_m / row.model_m);
}

/// Bound on the distance's error: by the vertex transform's shift of the plane, the driver's bound
/// and conversion.
double model_bound_m(const DepthMapping& mapping, const DepthCoding& coding,
                     const scene::DepthSample& sample, double transform)
{
    const auto& [plane_depth, driver_bound, code] = sample.texel;
    const double drop = driver_bound + conversion_drop(coding, plane_depth - driver_bound);
    const double rise = driver_bound + conversion_rise(coding, plane_depth + driver_bound);
    return std::max(
        std::abs(mapping.light_distance_error_m(sample.light_distance_m, transform - drop)),
        std::abs(mapping.light_distance_error_m(sample.light_distance_m, transform + rise)));
}

} // namespace

std::string_view texel_class_name(TexelClass texel_class)
{
    constexpr std::array<std::string_view, texel_class_count> names{"nearest_code", "within_format",
                                                                    "within_model", "outside"};
    return names.at(static_cast<std::size_t>(texel_class));
}

double residual_codes(const DepthCoding& coding, const scene::TexelDepth& texel)
{
    return (coding.depth(texel.code) - texel.plane_depth) /
           (2 * coding.half_step(texel.plane_depth));
}

TexelClass classify_texel(const DepthCoding& coding, const scene::TexelDepth& texel)
{
    const double exact = texel.plane_depth;
    if (is_within_format(coding, texel.code, exact)) {
        const std::uint32_t nearest = coding.nearest_code(exact);
        const bool is_nearest =
            std::abs(coding.depth(texel.code) - exact) <= std::abs(coding.depth(nearest) - exact);
        return is_nearest ? TexelClass::nearest_code : TexelClass::within_format;
    }
    const bool is_modelled = may_be_converted(coding, texel.code, exact - texel.driver_bound,
                                              exact + texel.driver_bound);
    return is_modelled ? TexelClass::within_model : TexelClass::outside;
}

double histogram_end_codes(std::size_t bin)
{
    constexpr std::size_t last = std::tuple_size_v<decltype(DepthCertificate::histogram)> - 1;
    return bin < last ? std::ldexp(0.5, static_cast<int>(bin))
                      : std::numeric_limits<double>::infinity();
}

DepthCertificate certify_texels(const DepthCoding& coding,
                                std::span<const scene::TexelDepth> texels)
{
    DepthCertificate certificate;
    certificate.texels = texels.size();
    double squares = 0;
    for (const scene::TexelDepth& texel : texels) {
        const double magnitude = std::abs(residual_codes(coding, texel));
        ++certificate.counts.at(static_cast<std::size_t>(classify_texel(coding, texel)));
        ++certificate.histogram.at(bin_of(magnitude));
        squares += magnitude * magnitude;
        certificate.largest_residual_codes =
            std::max(certificate.largest_residual_codes, magnitude);
        certificate.largest_share_of_bound =
            std::max(certificate.largest_share_of_bound, share_of_bound(coding, texel));
    }
    if (!texels.empty()) {
        certificate.rms_residual_codes = std::sqrt(squares / static_cast<double>(texels.size()));
    }
    return certificate;
}

DepthErrorRow formula_row(const DepthMapping& mapping, const DepthCoding& coding,
                          double light_distance_m)
{
    const StoredDepth formula = stored_depth(mapping, coding, light_distance_m);
    DepthErrorRow row;
    row.light_distance_m = light_distance_m;
    row.depth = mapping.depth(light_distance_m);
    row.formula_code = formula.code;
    row.formula_error_m = formula.error_m;
    row.envelope_m = error_envelope_m(mapping, coding, light_distance_m);
    return row;
}

DepthErrorRow depth_error_row(const DepthMapping& mapping, const DepthCoding& coding,
                              const scene::DepthSample& sample)
{
    const double light_distance_m = sample.light_distance_m;
    DepthErrorRow row = formula_row(mapping, coding, light_distance_m);
    row.code = sample.texel.code;
    const SplitDepth stored = coding.split_depth(row.code);
    row.error_m = mapping.stored_error_m(light_distance_m, stored);
    row.stored_light_distance_m = mapping.light_distance_m(stored);
    const double transform = sample.texel.plane_depth - row.depth;
    row.transform_error_m = mapping.light_distance_error_m(light_distance_m, transform);
    row.model_m = model_bound_m(mapping, coding, sample, transform);
    row.texel_class = classify_texel(coding, sample.texel);
    return row;
}

MeasuredDepthError measured_depth_error(const DepthMapping& mapping,
                                        const scene::DepthMeasurement& measurement)
{
    if (measurement.samples.empty()) {
        throw std::invalid_argument("measured_depth_error: no sample");
    }
    const DepthCoding coding = DepthCoding::of(measurement.format);
    MeasuredDepthError error;
    error.missing = measurement.missing;
    error.max_excess_m = -std::numeric_limits<double>::infinity();
    std::vector<scene::TexelDepth> texels;
    error.rows.reserve(measurement.samples.size());
    texels.reserve(measurement.samples.size());
    for (const scene::DepthSample& sample : measurement.samples) {
        error.rows.push_back(depth_error_row(mapping, coding, sample));
        include_extremes(error, error.rows.back());
        texels.push_back(sample.texel);
    }
    add_moments(error);
    error.certificate = certify_texels(coding, texels);
    return error;
}

} // namespace gnomon::analysis
