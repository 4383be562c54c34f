#include "scene/depth/depth_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace gnomon::scene {
namespace {

using Kind = DepthFormat::Kind;

constexpr int fewest_unorm_bits = 8;
constexpr int most_unorm_bits = 24;

/// In the order of the enumerators.
constexpr auto format_table = std::to_array<DepthFormatTraits>({
    {Kind::d16, "d16", 16, Spacing::even, Conversion::gl, false, true, 0, 0},
    {Kind::d24, "d24", 24, Spacing::even, Conversion::gl, false, true, 0, 0},
    {Kind::d32, "d32", 32, Spacing::even, Conversion::gl, false, true, 0, 0},
    {Kind::d32f, "d32f", 32, Spacing::floating, Conversion::gl, false, true, 24, -149},
    {Kind::unorm, "u", most_unorm_bits, Spacing::even, Conversion::shader, false, true, 0, 0},
    {Kind::r32f, "r32f", 32, Spacing::floating, Conversion::shader, true, true, 24, -149},
    {Kind::r16f, "r16f", 16, Spacing::floating, Conversion::shader, true, true, 11, -24},
    {Kind::rgba8, "rgba8", 32, Spacing::packed, Conversion::shader, true, false, 0, 0},
});

/// Whether the rows follow the order of the enumerators.
constexpr bool kinds_follow_enumerators()
{
    for (std::size_t i = 0; i < format_table.size(); ++i) {
        if (format_table[i].kind != static_cast<Kind>(i)) {
            return false;
        }
    }
    return true;
}
static_assert(kinds_follow_enumerators(),
              "each kind needs its row, in the order of the enumerators");

} // namespace

bool DepthFormat::is_float() const
{
    return traits_of(*this).spacing == Spacing::floating;
}

const DepthFormatTraits& traits_of(DepthFormat format)
{
    return format_table.at(static_cast<std::size_t>(format.kind));
}

double float_step(DepthFormat format, double value)
{
    const DepthFormatTraits& traits = traits_of(format);
    const int exponent = value == 0 ? traits.least_exponent : std::ilogb(value);
    return std::ldexp(1.0, std::max(exponent - traits.significant_bits + 1, traits.least_exponent));
}

std::vector<DepthFormat> depth_formats()
{
    std::vector<DepthFormat> formats;
    for (const DepthFormatTraits& traits : format_table) {
        if (traits.kind != Kind::unorm) {
            formats.push_back({traits.kind, traits.bits});
        }
    }
    for (int bits = fewest_unorm_bits; bits <= most_unorm_bits; ++bits) {
        formats.push_back({Kind::unorm, bits});
    }
    return formats;
}

std::string depth_format_listing()
{
    std::string listing;
    for (const DepthFormatTraits& traits : format_table) {
        if (traits.kind != Kind::unorm) {
            listing += fmt::format("{}, ", traits.name);
        }
    }
    const std::string_view unorm = traits_of({Kind::unorm, most_unorm_bits}).name;
    return listing + fmt::format("{0}{1} to {0}{2}", unorm, fewest_unorm_bits, most_unorm_bits);
}

std::optional<DepthFormat> depth_format_from_name(std::string_view name)
{
    for (const DepthFormat format : depth_formats()) {
        if (name == depth_format_name(format)) {
            return format;
        }
    }
    return std::nullopt;
}

std::string depth_format_name(DepthFormat format)
{
    const std::string_view name = traits_of(format).name;
    return format.kind == Kind::unorm ? fmt::format("{}{}", name, format.bits) : std::string{name};
}

namespace {

/// The GLSL types and functions that depth_codes.glsl uses.
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
