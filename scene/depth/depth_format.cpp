#include "scene/depth/depth_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::scene {
namespace {

using Kind = DepthFormat::Kind;

constexpr int fewest_unorm_bits = 8;
constexpr int most_unorm_bits = 24;

/// By their enumerators.
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

/// Whether the row of each kind stands where its enumerator counts.
constexpr bool follows_enumerators()
{
    for (std::size_t i = 0; i < format_table.size(); ++i) {
        if (format_table[i].kind != static_cast<Kind>(i)) {
            return false;
        }
    }
    return true;
}
static_assert(follows_enumerators(), "each kind needs its row, in the order of the enumerators");

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

} // namespace gnomon::scene
