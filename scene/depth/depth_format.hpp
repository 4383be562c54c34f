#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// How a format's values are spaced in [0, 1].
enum class Spacing : std::uint8_t {
    even,     ///< code/(2^bits − 1)
    floating, ///< floating-point numbers
    packed,   ///< packed into four bytes, as lessons do (`colour_code`)
};

/// How a shadow map stores depth: `d…` are GL's depth formats; `u8`… are n-bit unorm, which the
/// shader writes to a depth texture; the others are colour textures.
struct DepthFormat {
    enum class Kind : std::uint8_t { d16, d24, d32, d32f, unorm, r32f, r16f, rgba8 };
    Kind kind = Kind::d24;
    int bits = 24; ///< of a texel: 8…24 for unorm, else the format's own width

    [[nodiscard]] bool is_float() const;
    friend bool operator==(const DepthFormat&, const DepthFormat&) = default;
};

/// What converts a fragment's depth to the stored value.
enum class Conversion : std::uint8_t {
    gl,     ///< GL
    shader, ///< the shader that draws the map; exact
};

/// Properties of a kind of format.
struct DepthFormatTraits {
    DepthFormat::Kind kind;
    std::string_view name; ///< of unorm formats without the bits
    int bits;              ///< of a texel; of unorm formats the maximum
    Spacing spacing;
    Conversion conversion;
    bool is_colour;       ///< a colour texture, which GL cannot compare with depths
    bool has_means;       ///< whether the mean of two texels represents a depth between theirs
    int significant_bits; ///< of a float; else 0
    int least_exponent;   ///< of a float: its smallest step is 2 to this; else 0
};
[[nodiscard]] const DepthFormatTraits& traits_of(DepthFormat format);

/// The step from a value to the next one farther from 0: 2^(e − significant bits + 1) for 2^e <=
/// |value| < 2^(e+1), at least the smallest step.
/// @param format  a float format
[[nodiscard]] double float_step(DepthFormat format, double value);

/// "d24", "u13", …; empty if the text names no format.
[[nodiscard]] std::optional<DepthFormat> depth_format_from_name(std::string_view name);
[[nodiscard]] std::string depth_format_name(DepthFormat format);
/// All formats: GL's depth formats, the colour formats, and the unorm formats by growing bits.
[[nodiscard]] std::vector<DepthFormat> depth_formats();
/// "d16, d24, …, u8 to u24".
[[nodiscard]] std::string depth_format_listing();

/// A map of 32-bit floats, the reference for other formats.
inline constexpr DepthFormat float_depth_format{DepthFormat::Kind::d32f, 32};

/// The code that a colour format stores for a value: the bits of a float, rounded to nearest even,
/// or the four bytes of rgba8, the first one uppermost (docs/depth_precision.md#rgba8).
/// @param format  r32f, r16f or rgba8
/// @param value   in [0, 1]
/// @throws std::invalid_argument  for another format.
[[nodiscard]] std::uint32_t colour_code(DepthFormat format, float value);

/// The value that lookups read from a colour format's code.
/// @throws std::invalid_argument  for another format.
[[nodiscard]] float colour_value(DepthFormat format, std::uint32_t code);

/// The code of depth 1 in any format: 2^bits − 1 for unorm.
[[nodiscard]] std::uint32_t code_of_one(DepthFormat format);

/// The unit r of glPolygonOffset at a depth: `units` of 1 add r to the window depth.
struct OffsetUnit {
    double depth = 0; ///< of the plane, without offset
    double r = 0;     ///< window depth
};

} // namespace gnomon::scene
