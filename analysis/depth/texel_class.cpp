#include "analysis/depth/texel_class.hpp"

#include "analysis/depth/conversion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::analysis {

namespace {

/// Residual over what the driver's bound and conversion allow on its side of the exact depth.
double share_of_bound(const DepthCoding& coding, const scene::TexelDepth& texel)
{
    const double residual = coding.depth(texel.code) - texel.plane_depth;
    const double conversion = residual < 0
                                  ? conversion_drop(coding, texel.plane_depth - texel.driver_bound)
                                  : conversion_rise(coding, texel.plane_depth + texel.driver_bound);
    return std::abs(residual) / (texel.driver_bound + conversion);
}

/// One of the two nearest codes; packed, where near depths can have far codes, one of the two
/// nearest float32s'.
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

} // namespace gnomon::analysis
