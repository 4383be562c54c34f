#include "analysis/depth/depth_coding.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

constexpr int fewest_bits = 8;
constexpr int most_bits = 32;
constexpr int float_bits = 0;

} // namespace

DepthCoding DepthCoding::unorm(int bits)
{
    if (bits < fewest_bits || bits > most_bits) {
        throw std::domain_error("DepthCoding::unorm: bits must be 8 to 32");
    }
    return DepthCoding{bits};
}

DepthCoding DepthCoding::float32()
{
    return DepthCoding{float_bits};
}

DepthCoding DepthCoding::of(scene::DepthFormat format)
{
    return format.is_float() ? float32() : unorm(format.bits);
}

std::uint32_t DepthCoding::largest_code() const
{
    return is_float() ? std::bit_cast<std::uint32_t>(1.0F)
                      : static_cast<std::uint32_t>((std::uint64_t{1} << bits_) - 1);
}

std::uint32_t DepthCoding::nearest_code(double depth) const
{
    const double clamped = std::clamp(depth, 0.0, 1.0);
    if (is_float()) {
        return std::bit_cast<std::uint32_t>(static_cast<float>(clamped));
    }
    return static_cast<std::uint32_t>(std::floor(clamped * largest_code() + 0.5));
}

double DepthCoding::depth(std::uint32_t code) const
{
    return is_float() ? double{std::bit_cast<float>(code)}
                      : code / static_cast<double>(largest_code());
}

SplitDepth DepthCoding::split_depth(std::uint32_t code) const
{
    const double complement = is_float()
                                  ? 1 - depth(code)
                                  : (largest_code() - code) / static_cast<double>(largest_code());
    return {depth(code), complement};
}

double DepthCoding::half_step(double depth) const
{
    return is_float() ? std::min(half_float32_step(depth), 0x1p-25) : 0.5 / largest_code();
}

double half_float32_step(double value)
{
    constexpr int smallest_normal_exponent = -125; // of frexp, whose mantissa lies in [½, 1)
    int exponent = smallest_normal_exponent;
    if (value != 0) {
        std::frexp(value, &exponent);
    }
    return std::ldexp(1.0, std::max(exponent, smallest_normal_exponent) - 25);
}

} // namespace gnomon::analysis
