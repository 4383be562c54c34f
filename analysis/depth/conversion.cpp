#include "analysis/depth/conversion.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

constexpr int signed_bits = 31;

/// Whether a conversion through signed integers may lose more than GL allows.
bool truncates(const DepthCoding& coding, double depth)
{
    return !coding.is_float() && coding.bits() > signed_bits && depth < 0x1p-9;
}

std::uint32_t truncated_code(double depth)
{
    return 2 * static_cast<std::uint32_t>(std::floor(std::ldexp(depth, signed_bits)));
}

} // namespace

CodeRange nearest_codes(const DepthCoding& coding, double depth)
{
    const double clamped = std::clamp(depth, 0.0, 1.0);
    if (!coding.is_float()) {
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

double conversion_drop(const DepthCoding& coding, double lowest)
{
    return truncates(coding, lowest) ? 0x1p-31 : 2 * coding.half_step(std::clamp(lowest, 0.0, 1.0));
}

double conversion_rise(const DepthCoding& coding, double highest)
{
    return 2 * coding.half_step(std::clamp(highest, 0.0, 1.0));
}

} // namespace gnomon::analysis
