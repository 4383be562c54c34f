#include "analysis/depth/depth_coding.hpp"

#include "scene/depth/depth_format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gnomon::analysis {

namespace {

using scene::DepthFormat;
using scene::Spacing;

constexpr int fewest_bits = 8;
constexpr int most_bits = 32;

using Kind = DepthFormat::Kind;

/// Half a unit in the last place; at 1, of the floats below.
double half_place(DepthFormat format, double depth)
{
    return 0.5 * std::min(float_step(format, depth), float_step(format, 0.5));
}

/// A byte b is k, or k − 1 from 129 on: k/256 becomes b/255, which is off by min(k, 256 − k)/65280.
/// A float32's rounding may change the first byte's k by one, which is off by at most 1/65280 more.
/// The other bytes are off by (1/510)(1/256 + 1/65536 + …) < 1/(510·255). The rest is float32
/// rounding: of d and z_ndc by at most 2^-25 and 2^-26, and of b/255 and three sums by 2^-25 each,
/// less than 2^-22 in all.
double packing_bound(double depth)
{
    const double k = std::floor(256 * depth);
    return (std::min(k, 256 - k) + 1) / 65280 + 1 / (510.0 * 255) + 0x1p-22;
}

/// The powers of two below 1.
std::vector<double> float_borders()
{
    std::vector<double> depths;
    constexpr int smallest_exponent = -149;
    for (int exponent = -1; exponent >= smallest_exponent; --exponent) {
        depths.push_back(std::ldexp(1.0, exponent));
    }
    return depths;
}

/// The depths at which the first byte changes.
std::vector<double> packing_borders()
{
    std::vector<double> depths;
    for (int k = 1; k < 256; ++k) {
        depths.push_back(k / 256.0);
    }
    return depths;
}

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

/// Bound on the error of a conversion: one code, or half a step for packing, which has no choice.
double conversion_bound(const DepthCoding& coding, double depth)
{
    const double half_step = coding.half_step(std::clamp(depth, 0.0, 1.0));
    return coding.spacing() == Spacing::packed ? half_step : 2 * half_step;
}

/// The float32s next to an interval of depths: at or below `lowest`, at or above `highest`.
std::pair<double, double> float32s_about(double lowest, double highest)
{
    const auto below = static_cast<float>(lowest);
    const auto above = static_cast<float>(highest);
    return {double{below} > lowest ? std::nextafter(below, -1.0F) : below,
            double{above} < highest ? std::nextafter(above, 2.0F) : above};
}

/// The depth with three digits to the base of 256.
double depth_of_digits(const std::array<std::uint32_t, 3>& digits)
{
    return std::ldexp(double(digits[0] << 16U | digits[1] << 8U | digits[2]), -24);
}

/// Whether some depth in [lowest, highest] packs to these bytes. A digit and the next one decide a
/// byte; the rest of the depth rounds to the last byte.
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

DepthCoding DepthCoding::unorm(int bits)
{
    if (bits < fewest_bits || bits > most_bits) {
        throw std::domain_error("DepthCoding::unorm: bits must be 8 to 32");
    }
    return DepthCoding{{Kind::unorm, bits}};
}

DepthCoding DepthCoding::float32()
{
    return DepthCoding{{Kind::r32f, 32}};
}

DepthCoding DepthCoding::float16()
{
    return DepthCoding{{Kind::r16f, 16}};
}

DepthCoding DepthCoding::packed()
{
    return DepthCoding{{Kind::rgba8, 32}};
}

DepthCoding DepthCoding::of(DepthFormat format)
{
    if (traits_of(format).spacing == Spacing::even) {
        return unorm(format.bits);
    }
    return format.kind == Kind::d32f ? float32() : DepthCoding{format};
}

std::uint32_t DepthCoding::largest_code() const
{
    return scene::code_of_one(format_);
}

std::uint32_t DepthCoding::nearest_code(double depth) const
{
    const double clamped = std::clamp(depth, 0.0, 1.0);
    return spacing() == Spacing::even
               ? static_cast<std::uint32_t>(std::floor(clamped * largest_code() + 0.5))
               : colour_code(format_, static_cast<float>(clamped));
}

double DepthCoding::depth(std::uint32_t code) const
{
    return spacing() == Spacing::even ? code / static_cast<double>(largest_code())
                                      : double{colour_value(format_, code)};
}

SplitDepth DepthCoding::split_depth(std::uint32_t code) const
{
    const double complement = spacing() == Spacing::even
                                  ? (largest_code() - code) / static_cast<double>(largest_code())
                                  : 1 - depth(code);
    return {depth(code), complement};
}

double DepthCoding::half_step(double depth) const
{
    switch (spacing()) {
    case Spacing::even:
        return 0.5 / largest_code();
    case Spacing::floating: {
        const double float32s = half_place(scene::float_depth_format, depth);
        return format_.kind == Kind::r32f ? float32s : half_place(format_, depth) + float32s;
    }
    case Spacing::packed:
        break;
    }
    return packing_bound(depth);
}

std::vector<double> DepthCoding::borders() const
{
    switch (spacing()) {
    case Spacing::even:
        return {};
    case Spacing::floating:
        return float_borders();
    case Spacing::packed:
        break;
    }
    return packing_borders();
}

double half_float32_step(double value)
{
    return 0.5 * float_step(scene::float_depth_format, value);
}

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
