#include "analysis/depth/conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gnomon::analysis {

namespace {

using scene::Spacing;

constexpr int signed_bits = 31;

/// Whether a conversion through signed integers may lose more than GL allows.
bool truncates(const DepthCoding& coding, double depth)
{
    return coding.spacing() == Spacing::even && coding.bits() > signed_bits && depth < 0x1p-9;
}

std::uint32_t truncated_code(double depth)
{
    return 2 * static_cast<std::uint32_t>(std::floor(std::ldexp(depth, signed_bits)));
}

/// Bound on how far a conversion leads: to the neighbouring code, but packing has only one.
double conversion_bound(const DepthCoding& coding, double depth)
{
    const double half_step = coding.half_step(std::clamp(depth, 0.0, 1.0));
    return coding.spacing() == Spacing::packed ? half_step : 2 * half_step;
}

/// The float32s between which a depth lies.
std::pair<double, double> float32s_about(double lowest, double highest)
{
    const auto below = static_cast<float>(lowest);
    const auto above = static_cast<float>(highest);
    return {double{below} > lowest ? std::nextafter(below, -1.0F) : below,
            double{above} < highest ? std::nextafter(above, 2.0F) : above};
}

/// A depth of three digits to the base of 256.
double depth_of_digits(const std::array<std::uint32_t, 3>& digits)
{
    return std::ldexp(double(digits[0] << 16U | digits[1] << 8U | digits[2]), -24);
}

/// Whether some depth in [lowest, highest] is packed to these bytes. A byte is that of two digits
/// at most, itself and the next one; what is left of the depth is what rounds to the last byte.
bool packs_between(std::uint32_t bytes, double lowest, double highest)
{
    const DepthCoding packed = DepthCoding::packed();
    if (bytes == packed.largest_code()) {
        return highest >= 1;
    }
    const std::uint32_t last = bytes & 0xFFU;
    const double rest_from = std::ldexp(std::max(2.0 * last - 1, 0.0) / 510, -24);
    const double rest_to = std::ldexp(std::min(2.0 * last + 1, 510.0) / 510, -24);
    for (std::uint32_t carries = 0; carries < 8; ++carries) {
        const std::array digits{(bytes >> 24U) + (carries & 1U),
                                (bytes >> 16U & 0xFFU) + (carries >> 1U & 1U),
                                (bytes >> 8U & 0xFFU) + (carries >> 2U)};
        const double depth = depth_of_digits(digits);
        const bool is_packed_so = std::ranges::all_of(digits, [](auto k) { return k < 256; }) &&
                                  packed.nearest_code(depth) >> 8U == bytes >> 8U;
        if (is_packed_so && depth + rest_from <= highest && depth + rest_to >= lowest) {
            return true;
        }
    }
    return false;
}

} // namespace

CodeRange nearest_codes(const DepthCoding& coding, double depth)
{
    const double clamped = std::clamp(depth, 0.0, 1.0);
    if (coding.spacing() == Spacing::even) {
        const double steps = clamped * coding.largest_code();
        return {static_cast<std::uint32_t>(std::floor(steps)),
                static_cast<std::uint32_t>(std::ceil(steps))};
    }
    const std::uint32_t code = coding.nearest_code(clamped);
    // The bits of floats >= 0 are in order.
    return {coding.depth(code) > clamped ? code - 1 : code,
            coding.depth(code) < clamped ? code + 1 : code};
}

CodeRange converted_codes(const DepthCoding& coding, double lowest, double highest)
{
    const std::uint32_t lower = nearest_codes(coding, lowest).lower;
    return {truncates(coding, lowest) ? std::min(lower, truncated_code(std::max(lowest, 0.0)))
                                      : lower,
            nearest_codes(coding, highest).upper};
}

bool may_be_converted(const DepthCoding& coding, std::uint32_t code, double lowest, double highest)
{
    if (coding.spacing() != Spacing::packed) {
        return converted_codes(coding, lowest, highest).holds(code);
    }
    const auto [below, above] = float32s_about(std::max(lowest, 0.0), std::min(highest, 1.0));
    return packs_between(code, below, above);
}

double conversion_drop(const DepthCoding& coding, double lowest)
{
    return truncates(coding, lowest) ? 0x1p-31 : conversion_bound(coding, lowest);
}

double conversion_rise(const DepthCoding& coding, double highest)
{
    return conversion_bound(coding, highest);
}

} // namespace gnomon::analysis
