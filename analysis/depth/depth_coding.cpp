#include "analysis/depth/depth_coding.hpp"

#include "scene/depth/depth_codes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

constexpr int fewest_bits = 8;
constexpr int most_bits = 32;

using scene::DepthFormat;
using scene::Spacing;
using Kind = DepthFormat::Kind;

/// Half a unit in the last place; at 1 that of the floats below.
double half_place(DepthFormat format, double depth)
{
    return 0.5 * std::min(float_step(format, depth), float_step(format, 0.5));
}

/// A byte b is k, or k − 1 from 129 on: k/256 becomes b/255, which is off by min(k, 256 − k)/65280.
/// Of the first byte k is known but for a float32's rounding, and the next k is off by 1/65280 more
/// at most. The others are off by (1/510)(1/256 + 1/65536 + …) < 1/(510·255). What is left is a
/// float32's rounding of d and of z_ndc, 2^-25 and 2^-26 at most, and of b/255 and three sums,
/// 2^-25 each: less than 2^-22.
double packing_bound(double depth)
{
    const double k = std::floor(256 * depth);
    return (std::min(k, 256 - k) + 1) / 65280 + 1 / (510.0 * 255) + 0x1p-22;
}

/// Powers of two.
std::vector<double> float_borders()
{
    std::vector<double> depths;
    constexpr int smallest_exponent = -149;
    for (int exponent = -1; exponent >= smallest_exponent; --exponent) {
        depths.push_back(std::ldexp(1.0, exponent));
    }
    return depths;
}

/// Where the first byte changes.
std::vector<double> packing_borders()
{
    std::vector<double> depths;
    for (int k = 1; k < 256; ++k) {
        depths.push_back(k / 256.0);
    }
    return depths;
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

} // namespace gnomon::analysis
