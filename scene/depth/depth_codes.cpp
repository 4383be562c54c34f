#include "scene/depth/depth_codes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

namespace gnomon::scene {
namespace {

/// GLSL's words, as far as depth_codes.glsl uses them.
namespace shader {

using uint = std::uint32_t;

uint floatBitsToUint(float value)
{
    return std::bit_cast<uint>(value);
}

float uintBitsToFloat(uint bits)
{
    return std::bit_cast<float>(bits);
}

int findMSB(uint value)
{
    return static_cast<int>(std::bit_width(value)) - 1;
}

#define precise // C++ rounds each sum anyway
#include "scene/depth/depth_codes.glsl"
#undef precise

} // namespace shader

using Kind = DepthFormat::Kind;

struct ColourCoding {
    Kind kind;
    std::uint32_t (*code)(float value);
    float (*value)(std::uint32_t code);
};
constexpr auto colour_codings = std::to_array<ColourCoding>({
    {Kind::r32f, shader::floatBitsToUint, shader::uintBitsToFloat},
    {Kind::r16f, shader::half_of_float, shader::float_of_half},
    {Kind::rgba8, shader::packed_of_float, shader::float_of_packed},
});

const ColourCoding& coding_of(DepthFormat format)
{
    const auto found = std::ranges::find(colour_codings, format.kind, &ColourCoding::kind);
    if (found == colour_codings.end()) {
        throw std::invalid_argument("depth_codes: format: " + depth_format_name(format) +
                                    " is no colour format");
    }
    return *found;
}

} // namespace

std::uint32_t colour_code(DepthFormat format, float value)
{
    return coding_of(format).code(value);
}

float colour_value(DepthFormat format, std::uint32_t code)
{
    return coding_of(format).value(code);
}

std::uint32_t code_of_one(DepthFormat format)
{
    if (traits_of(format).is_colour) {
        return colour_code(format, 1.0F);
    }
    return format.is_float() ? std::bit_cast<std::uint32_t>(1.0F)
                             : static_cast<std::uint32_t>((std::uint64_t{1} << format.bits) - 1);
}

} // namespace gnomon::scene
